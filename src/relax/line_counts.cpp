#include "relax/line_counts.h"

#include "base/status.h"
#include "relax/drop_dead.h"
#include "sample/track.h"

namespace isolod {
inline namespace v1 {

namespace {

HalfedgeId edge_between(const Halfedges& mesh, SampleId a, SampleId b) {
  const HalfedgeId h = find_halfedge(mesh, vertex(a), vertex(b));
  return h.is_none() ? find_halfedge(mesh, vertex(b), vertex(a)) : h;
}

/// Merges s into a neighbour on its line.
bool merge_along_line(Triangulation& mesh, SampleId s) {
  HalfedgeId way = none<HalfedgeId>();
  visit_outgoing(mesh.mesh, vertex(s), [&](HalfedgeId h) {
    if (way.is_none() && mesh.is_fixed(h) && can_collapse(mesh, h)) way = h;
  });
  if (way.is_none()) return false;
  collapse(mesh, way);
  return true;
}

class LineMatch {
 public:
  LineMatch(const Surface& surface, const Backbones& features, Triangulation& mesh, Samples& samples)
      : surface_(surface), features_(features), mesh_(mesh), samples_(samples) {}

  Status begin(Arena& arena) {
    ISOLOD_TRY(collect_riders(surface_, features_, samples_, riders_, arena));
    return begin_track(features_, track_, arena);
  }

  /// Before any were added or removed.
  std::uint32_t inner_count(std::size_t b) const { return static_cast<std::uint32_t>(riders_.on(b).count); }

  /// Every so many-th one, so that spreading moves none far.
  void remove(std::size_t b, std::uint32_t count) {
    const Span<const Rider> on = riders_.on(b);
    std::uint32_t owed = 0;
    for (std::size_t i = 0; i < on.count; ++i) {
      owed += count;
      if (owed < on.count) continue;
      if (merge_along_line(mesh_, on[i].sample)) owed -= static_cast<std::uint32_t>(on.count);
    }
  }

  void add(std::size_t b, std::uint32_t count) {
    const std::size_t inner = riders_.on(b).count;
    const std::size_t intervals = is_closed(surface_, features_, b) ? inner : inner + 1;
    fill_track(surface_, features_, b, track_);
    std::size_t done = 0;
    for (std::size_t i = 0; i < intervals; ++i) {
      const std::size_t until = (i + 1) * count / intervals;
      halve(b, i, static_cast<std::uint32_t>(until - done));
      done = until;
    }
  }

 private:
  double mass_of(std::size_t b, std::size_t i, bool end) const {
    const Span<const Rider> on = riders_.on(b);
    const double whole = track_.whole_mass();
    if (end) return i < on.count ? mass_at(track_, on[i].place) : whole;
    if (i > 0) return mass_at(track_, on[i - 1].place);
    return track_.closed ? mass_at(track_, on[on.count - 1].place) - whole : 0;
  }

  /// Puts `count` samples into interval i, the last nearest to its beginning.
  void halve(std::size_t b, std::size_t i, std::uint32_t count) {
    const LineInterval ends = interval_of(surface_, features_, riders_, b, i);
    const double from = mass_of(b, i, false);
    double to = mass_of(b, i, true);
    SampleId end = ends.to;
    for (std::uint32_t k = 0; k < count; ++k) {
      const HalfedgeId h = edge_between(mesh_.mesh, ends.from, end);
      if (h.is_none()) return;
      to = 0.5 * (from + to);
      const LinePlace place = place_at_mass(track_, to < 0 ? to + track_.whole_mass() : to);
      end = SampleId{static_cast<std::uint32_t>(samples_.count())};
      samples_.set_count(samples_.count() + 1);
      samples_.put_on_line(end, {features_.edge[place.edge], place.along});
      split_edge(mesh_, h, vertex(end));
    }
  }

  const Surface& surface_;
  const Backbones& features_;
  Triangulation& mesh_;
  Samples& samples_;
  Riders riders_;
  Track track_;
};

}  // namespace

LineChange change_after_split(const Surface& surface, const Backbones& features, const Riders& riders,
                              const LineSamples& wished) {
  LineChange change;
  for (std::size_t b = 0; b < features.count(); ++b) {
    const std::uint32_t inner = static_cast<std::uint32_t>(riders.on(b).count);
    const std::uint32_t split = is_closed(surface, features, b) ? 2 * inner : 2 * inner + 1;
    const std::uint32_t wish = wished.inner_count(b);
    (wish > split ? change.added : change.removed) += wish > split ? wish - split : split - wish;
  }
  return change;
}

Status match_line_counts(const Surface& surface, const Backbones& features, const LineSamples& wished,
                         Triangulation& mesh, Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  LineMatch match(surface, features, mesh, samples);
  ISOLOD_TRY(match.begin(arena));
  for (std::size_t b = 0; b < features.count(); ++b) {
    const std::uint32_t inner = match.inner_count(b), wish = wished.inner_count(b);
    if (inner > wish) match.remove(b, inner - wish);
    if (inner < wish) match.add(b, wish - inner);
  }
  return drop_dead_samples(mesh, samples, arena);
}

}  // namespace v1
}  // namespace isolod
