#include "relax/line_counts.h"

#include "base/status.h"
#include "relax/drop_dead.h"

namespace isolod {
inline namespace v1 {

namespace {

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
    fill_track(surface_, features_, b, track_);
    const std::size_t intervals = interval_count(track_, riders_.on(b));
    std::size_t done = 0;
    for (std::size_t i = 0; i < intervals; ++i) {
      const std::size_t until = (i + 1) * count / intervals;
      halve(b, i, static_cast<std::uint32_t>(until - done));
      done = until;
    }
  }

 private:
  /// Puts `count` samples into interval i, the last nearest to its beginning.
  void halve(std::size_t b, std::size_t i, std::uint32_t count) {
    const LineInterval ends = interval_of(surface_, features_, riders_, b, i);
    MassRange range = mass_of_interval(track_, riders_.on(b), i);
    SampleId end = ends.to;
    for (std::uint32_t k = 0; k < count; ++k) {
      const HalfedgeId h = find_edge(mesh_.mesh, vertex(ends.from), vertex(end));
      if (h.is_none()) return;
      range.to = 0.5 * (range.from + range.to);
      end = SampleId{static_cast<std::uint32_t>(samples_.count())};
      samples_.set_count(samples_.count() + 1);
      samples_.put_on_line(end, anchor_at_mass(features_, track_, range.to));
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

std::size_t match_line_bytes(const LineSizes& lines, std::size_t sample_count, std::size_t face_count) {
  return riders_bytes(lines) + track_bytes(lines.longest) + drop_dead_bytes(sample_count, face_count);
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
