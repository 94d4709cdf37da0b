#include "sample/keep_shape.h"

#include "base/array_bytes.h"
#include "base/sort.h"
#include "base/status.h"
#include "sample/track.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double least_spacing = 0.6;        // of the backbone's mean, in density
constexpr double clear_gain = 0.75;          // of the deviation: what the new chords may have at most
constexpr std::int32_t farthest_fixed = 16;  // samples to either side among which a fixed one is looked for
constexpr double wide_spacing = 1.4;         // of the mean: from here on a segment may be given one interval more
constexpr std::uint32_t most_keep_rounds = 8;

/// A sample or node on the track. Masses ascend; on a closed track they lie within one turn, which may begin below 0.
struct Point {
  double mass;
  std::uint32_t vertex;  // where it is fixed, or UINT32_MAX
};

/// The vertex that lies farthest from a chord. `mass` counts on through the turns of a closed track.
struct Deviation {
  double squared = 0;
  double mass = 0;
  std::uint32_t vertex = 0;
  std::int32_t chord = 0;
};

double squared_distance_to_chord(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a, away = p - a;
  const double whole = dot(along, along), part = dot(away, along);
  const double t = whole > 0 ? smaller(1, greater(0, part / whole)) : 0;
  const Vec3 off = away - t * along;
  return dot(off, off);
}

/// From one fixed point to the next.
struct Segment {
  Point from;
  double mass;
  std::int32_t count;  // of intervals
};

/// A segment that could give or take an interval; the least key comes first.
struct Offer {
  double key;
  std::uint32_t segment;
};

class ShapeKeeper {
 public:
  ShapeKeeper(const Surface& surface, const Backbones& backbones, double tolerance)
      : surface_(surface), backbones_(backbones), tolerance_(tolerance) {}

  Status begin(const LineSamples& samples, Arena& arena) {
    const std::size_t most = most_samples(samples) + std::size_t{2};
    ISOLOD_TRY(begin_track(backbones_, track_, arena));
    ISOLOD_TRY(arena.scratch(most, point_));
    ISOLOD_TRY(arena.scratch(most, best_));
    ISOLOD_TRY(arena.scratch(most, deviation_));
    ISOLOD_TRY(arena.scratch(most, buffer_));
    ISOLOD_TRY(arena.scratch(most, segment_));
    ISOLOD_TRY(arena.scratch(most, giver_));
    ISOLOD_TRY(arena.scratch(most, taker_));
    return arena.scratch(most, offers_);
  }

  void keep(std::size_t b, Span<LinePlace> places, Span<std::uint8_t> pinned) {
    fill_track(surface_, backbones_, b, track_);
    load(places);
    double least = measure();
    std::uint32_t best_round = 0;
    for (std::uint32_t round = 1; round <= most_keep_rounds && pull_all(); ++round) {
      cut();
      balance();
      spread();
      const double excess = measure();
      if (!(excess < least)) continue;
      least = excess;
      best_round = round;
      for (std::size_t i = 0; i < point_.count; ++i) best_[i] = point_[i];
    }
    if (best_round != 0) store(places, pinned);
  }

 private:
  std::int32_t count() const { return static_cast<std::int32_t>(point_.count); }
  std::int32_t chord_count() const { return track_.closed ? count() : count() - 1; }

  /// Points of a closed track go on beyond both ends.
  Point at(std::int32_t i) const {
    if (i < 0) return {point_[i + count()].mass - track_.whole_mass(), point_[i + count()].vertex};
    if (i >= count()) return {point_[i - count()].mass + track_.whole_mass(), point_[i - count()].vertex};
    return point_[i];
  }
  bool is_fixed(std::int32_t i) const { return at(i).vertex != UINT32_MAX; }

  Vec3 vertex_position(std::uint32_t k) const {
    const bool is_last = k == track_.edge_count();
    const HalfedgeId h = backbones_.edge[track_.first + k - is_last];
    return surface_.position(is_last ? surface_.mesh.target(h) : surface_.mesh.origin[h]);
  }

  /// The whole turns, as a mass, between `mass` and its like on the track.
  double turns(double mass) const {
    const double whole = track_.whole_mass();
    if (!track_.closed) return 0;
    return mass < -whole ? -2 * whole : mass < 0 ? -whole : mass < whole ? 0 : mass < 2 * whole ? whole : 2 * whole;
  }

  Vec3 position(const Point& p) const {
    if (p.vertex != UINT32_MAX) return vertex_position(p.vertex);
    const LinePlace place = place_at_mass(track_, p.mass - turns(p.mass));
    const Vec3 a = vertex_position(place.edge - track_.first), b = vertex_position(place.edge - track_.first + 1);
    return a + place.along * (b - a);
  }

  void load(Span<const LinePlace> places) {
    point_.count = 0;
    if (!track_.closed) point_[point_.count++] = {0, 0};
    for (const LinePlace& place : places) point_[point_.count++] = {mass_at(track_, place), UINT32_MAX};
    if (!track_.closed) point_[point_.count++] = {track_.whole_mass(), track_.edge_count()};
    mean_spacing_ = track_.whole_mass() / static_cast<double>(chord_count());
  }

  /// The worst of the vertices strictly between two points.
  Deviation worst_between(const Point& from, const Point& to) const {
    const Vec3 a = position(from), b = position(to);
    double turn = turns(from.mass);
    std::uint32_t k = vertex_after(track_, from.mass - turn);
    Deviation worst;
    for (std::uint32_t steps = 0; steps < 2 * track_.edge_count(); ++steps, ++k) {
      if (k >= track_.edge_count()) {
        if (!track_.closed) break;
        turn += track_.whole_mass();
        k = 0;
      }
      const double mass = track_.mass[k] + turn;
      if (!(mass < to.mass)) break;
      const double squared = squared_distance_to_chord(vertex_position(k), a, b);
      if (squared > worst.squared) worst = {squared, mass, k, 0};
    }
    return worst;
  }

  /// Lists the chords that deviate too much, and returns by how much they do: the sum of the squared excesses.
  double measure() {
    double excess = 0;
    deviation_.count = 0;
    for (std::int32_t i = 0; i < chord_count(); ++i) {
      Deviation worst = worst_between(at(i), at(i + 1));
      if (!(worst.squared > tolerance_ * tolerance_)) continue;
      const double beyond = square_root(worst.squared) - tolerance_;
      excess += beyond * beyond;
      worst.chord = i;
      deviation_[deviation_.count++] = worst;
    }
    return excess;
  }

  bool pull_all() {
    merge_sort(deviation_, buffer_, [](const Deviation& a, const Deviation& b) {
      return a.squared > b.squared || (a.squared == b.squared && a.chord < b.chord);
    });
    bool any = false;
    for (const Deviation& worst : deviation_) {
      const std::int32_t left = worst.chord, right = left + 1;
      const bool left_is_nearer = worst.mass - at(left).mass <= at(right).mass - worst.mass;
      const bool pulled =
          try_pull(left_is_nearer ? left : right, worst) || try_pull(left_is_nearer ? right : left, worst);
      any = any || pulled;
    }
    return any;
  }

  /// The spacing on one side of sample s, once it is at `mass` and those up to the next fixed one are spread.
  double spacing_after(std::int32_t s, double mass, std::int32_t side) const {
    const std::int32_t most = farthest_fixed < count() ? farthest_fixed : count();
    std::int32_t steps = 1;
    while (steps < most && !is_fixed(s + side * steps)) ++steps;
    const double way = at(s + side * steps).mass - mass;
    return static_cast<double>(side) * way / static_cast<double>(steps);
  }

  /// The point that would be next to the vertex then.
  Point neighbour_after(std::int32_t s, const Deviation& worst, std::int32_t side, double spacing) const {
    const Point present = at(s + side);
    if (present.vertex != UINT32_MAX) return present;
    return {worst.mass + static_cast<double>(side) * spacing, UINT32_MAX};
  }

  bool try_pull(std::int32_t s, Deviation worst) {
    if (is_fixed(s)) return false;
    if (s >= count()) {
      s -= count();
      worst.mass -= track_.whole_mass();
    }
    const double left = spacing_after(s, worst.mass, -1), right = spacing_after(s, worst.mass, 1);
    if (!(smaller(left, right) >= least_spacing * mean_spacing_)) return false;
    const Point here{worst.mass, worst.vertex};
    const double allowed = greater(tolerance_ * tolerance_, clear_gain * clear_gain * worst.squared);
    if (worst_between(neighbour_after(s, worst, -1, left), here).squared > allowed) return false;
    if (worst_between(here, neighbour_after(s, worst, 1, right)).squared > allowed) return false;
    point_[s] = here;
    return true;
  }

  /// Lists the segments between fixed points: on a closed track from the first pin on, once around.
  void cut() {
    std::int32_t from = 0;
    while (!is_fixed(from)) ++from;
    const std::int32_t end = track_.closed ? from + count() : count() - 1;
    segment_.count = 0;
    for (std::int32_t i = from + 1; i <= end; ++i) {
      if (!is_fixed(i)) continue;
      segment_[segment_.count++] = {at(from), at(i).mass - at(from).mass, i - from};
      from = i;
    }
  }

  /// Moves intervals to where they are wide from where they are narrow, one a segment at most, while that evens them.
  void balance() {
    giver_.count = taker_.count = 0;
    for (std::uint32_t i = 0; i < segment_.count; ++i) {
      if (segment_[i].count > 1) giver_[giver_.count++] = {spacing(i, -1), i};
      if (spacing(i, 0) > wide_spacing * mean_spacing_) taker_[taker_.count++] = {-spacing(i, 0), i};
    }
    const auto less = [](const Offer& a, const Offer& b) {
      return a.key < b.key || (a.key == b.key && a.segment < b.segment);
    };
    merge_sort(giver_, offers_, less);
    merge_sort(taker_, offers_, less);
    for (std::size_t i = 0; i < giver_.count && i < taker_.count && giver_[i].key < -taker_[i].key; ++i) {
      --segment_[giver_[i].segment].count;
      ++segment_[taker_[i].segment].count;
    }
  }

  double spacing(std::uint32_t segment, std::int32_t more) const {
    return segment_[segment].mass / static_cast<double>(segment_[segment].count + more);
  }

  /// Puts the points of every segment at equal steps of mass.
  void spread() {
    const double shift = turns(segment_[0u].from.mass);
    point_.count = 0;
    for (const Segment& segment : segment_) {
      const double start = segment.from.mass - shift;
      point_[point_.count++] = {start, segment.from.vertex};
      const double step = segment.mass / static_cast<double>(segment.count);
      for (std::int32_t i = 1; i < segment.count; ++i) {
        point_[point_.count++] = {start + static_cast<double>(i) * step, UINT32_MAX};
      }
    }
    if (!track_.closed) point_[point_.count++] = {track_.whole_mass(), track_.edge_count()};
  }

  void store(Span<LinePlace> places, Span<std::uint8_t> pinned) const {
    const std::size_t inner = places.count, skip = track_.closed ? 0 : 1;
    std::size_t first = 0;
    const auto on_track = [&](std::size_t i) {
      const Point& p = best_[i];
      return p.vertex != UINT32_MAX ? track_.mass[p.vertex] : p.mass - turns(p.mass);
    };
    for (std::size_t i = 1; track_.closed && i < inner; ++i) {
      if (on_track(i) < on_track(first)) first = i;
    }
    for (std::size_t i = 0; i < inner; ++i) {
      const std::size_t from = track_.closed ? (first + i) % inner : i + skip;
      const std::uint32_t vertex = best_[from].vertex;
      pinned[i] = vertex != UINT32_MAX;
      places[i] = pinned[i] ? LinePlace{track_.first + vertex, 0} : place_at_mass(track_, on_track(from));
    }
  }

  const Surface& surface_;
  const Backbones& backbones_;
  double tolerance_;
  Track track_;
  Span<Point> point_, best_;
  Span<Deviation> deviation_, buffer_;
  Span<Segment> segment_;
  Span<Offer> giver_, taker_, offers_;
  double mean_spacing_ = 0;
};

}  // namespace

std::size_t keep_shape_bytes(const LineSizes& lines) {
  const std::size_t most = lines.samples + 2;
  return track_bytes(lines.longest) + 2 * array_bytes<Point>(most) + 2 * array_bytes<Deviation>(most) +
         array_bytes<Segment>(most) + 3 * array_bytes<Offer>(most);
}

Status keep_line_shape(const Surface& surface, const Backbones& backbones, double tolerance, LineSamples& samples,
                       Span<std::uint8_t> pinned, Arena& arena) {
  const ScratchScope scope(arena);
  ShapeKeeper keeper(surface, backbones, tolerance);
  ISOLOD_TRY(keeper.begin(samples, arena));
  for (std::uint8_t& flag : pinned) flag = 0;
  for (std::size_t b = 0; b < backbones.count(); ++b) {
    const std::uint32_t start = samples.start[b], inner = samples.inner_count(b);
    if (inner == 0 || !is_feature(surface, backbones, b)) continue;
    keeper.keep(b, samples.place.slice(start, inner), pinned.slice(start, inner));
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
