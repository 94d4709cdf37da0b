#include "sample/lloyd_line.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "sample/track.h"

namespace isolod {
inline namespace v1 {

namespace {

/// Walks once along a track, summing the weight over one cell after the other.
class CellWalk {
 public:
  CellWalk(const Track& track, Span<const double> weight, double from)
      : track_(track), weight_(weight), offset_(track.closed && from < 0 ? -track.whole_length() : 0) {}

  /// The centroid of the weight from `from` to `to`, where the last cell ended or later.
  double centroid(double from, double to) {
    const double middle = 0.5 * (from + to);
    mass_ = moment_ = 0;
    for (;;) {
      add_edge(from, to, middle);
      if (track_.arc[edge_ + 1] + offset_ >= to || !go_on()) break;
    }
    if (!(mass_ > 0)) return middle;
    return smaller(to, greater(from, middle + moment_ / mass_));
  }

 private:
  /// Moments about the middle of the cell, not about the start of the line: those would cancel.
  void add_edge(double from, double to, double middle) {
    const double low = track_.arc[edge_] + offset_, high = track_.arc[edge_ + 1] + offset_;
    const double a = greater(from, low), b = smaller(to, high);
    if (!(b > a)) return;
    const double near = weight_[2 * edge_], slope = (weight_[2 * edge_ + 1] - near) / (high - low);
    const double at_a = near + slope * (a - low), at_b = near + slope * (b - low);
    mass_ += 0.5 * (b - a) * (at_a + at_b);
    moment_ += (b - a) * ((a - middle) * (2 * at_a + at_b) + (b - middle) * (at_a + 2 * at_b)) / 6;
  }

  /// All cells together are one turn, begun before its end: three turns are never walked.
  bool go_on() {
    if (++edge_ < track_.edge_count()) return true;
    if (!track_.closed || ++turns_ == 3) return --edge_, false;
    edge_ = 0;
    offset_ += track_.whole_length();
    return true;
  }

  const Track& track_;
  Span<const double> weight_;
  double offset_;
  std::uint32_t edge_ = 0, turns_ = 0;
  double mass_ = 0, moment_ = 0;
};

class LineLloyd {
 public:
  Status begin(const Backbones& backbones, const LineSamples& samples, Arena& arena) {
    ISOLOD_TRY(begin_track(backbones, track_, arena));
    ISOLOD_TRY(arena.scratch(track_.density.count, weight_));
    ISOLOD_TRY(arena.scratch(most_samples(samples), now_));
    return arena.scratch(now_.count, next_);
  }

  void relax(const Surface& surface, const Backbones& backbones, std::size_t b, LloydWeight weight,
             std::uint32_t iterations, Span<LinePlace> places) {
    if (places.empty()) return;
    fill_track(surface, backbones, b, track_);
    for (std::size_t k = 0; k < track_.density.count; ++k) {
      const double d = track_.density[k];
      weight_[k] = weight == LloydWeight::paper ? d : d * d * d;
    }
    now_.count = next_.count = places.count;
    for (std::size_t i = 0; i < places.count; ++i) now_[i] = arc_at(track_, places[i]);
    for (std::uint32_t i = 0; i < iterations; ++i) iterate();
    write(places);
  }

 private:
  void iterate() {
    const double whole = track_.whole_length();
    const double before = track_.closed ? now_[now_.count - 1] - whole : 0;
    const double behind = track_.closed ? now_[0u] + whole : whole;
    double from = 0.5 * (before + now_[0u]);
    CellWalk walk(track_, weight_, from);
    for (std::size_t i = 0; i < now_.count; ++i) {
      const double to = 0.5 * (now_[i] + (i + 1 < now_.count ? now_[i + 1] : behind));
      next_[i] = walk.centroid(from, to);
      from = to;
    }
    const Span<double> swap = now_;
    now_ = next_;
    next_ = swap;
    if (track_.closed) wrap();
  }

  /// Brings the samples of a closed backbone back between 0 and its length, the first one foremost.
  void wrap() {
    const double whole = track_.whole_length();
    std::size_t below = 0, kept = now_.count;
    while (below < now_.count && now_[below] < 0) ++below;
    while (kept > below && now_[kept - 1] >= whole) --kept;
    if (below == 0 && kept == now_.count) return;
    std::size_t filled = 0;
    for (std::size_t i = kept; i < now_.count; ++i) next_[filled++] = now_[i] - whole;
    for (std::size_t i = below; i < kept; ++i) next_[filled++] = now_[i];
    for (std::size_t i = 0; i < below; ++i) next_[filled++] = now_[i] + whole;
    const Span<double> swap = now_;
    now_ = next_;
    next_ = swap;
  }

  void write(Span<LinePlace> places) const {
    std::uint32_t k = 0;
    for (std::size_t i = 0; i < places.count; ++i) {
      while (k + 1 < track_.edge_count() && track_.arc[k + 1] <= now_[i]) ++k;
      places[i] = place_on(track_, k, now_[i]);
    }
  }

  Track track_;
  Span<double> weight_, now_, next_;
};

}  // namespace

std::size_t relax_lines_bytes(const LineSizes& lines) {
  return track_bytes(lines.longest) + array_bytes<double>(2 * lines.longest) + 2 * array_bytes<double>(lines.samples);
}

Status relax_lines(const Surface& surface, const Backbones& backbones, LineSamples& samples, LloydWeight weight,
                   std::uint32_t iterations, Arena& arena) {
  const ScratchScope scope(arena);
  LineLloyd lloyd;
  ISOLOD_TRY(lloyd.begin(backbones, samples, arena));
  for (std::size_t b = 0; b < backbones.count(); ++b) {
    const Span<LinePlace> places = samples.place.slice(samples.start[b], samples.inner_count(b));
    lloyd.relax(surface, backbones, b, weight, iterations, places);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
