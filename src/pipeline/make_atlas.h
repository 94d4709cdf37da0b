// The atlas: a partition of the surface whose charts all have good maps. A chart whose map fails is split in two and
// tried again; a single triangle always passes, so this ends.
#pragma once

#include "atlas/chart.h"
#include "atlas/regions.h"
#include "plane/chart_sites.h"

namespace isolod {
inline namespace v1 {

struct AtlasOptions {
  double line_rate = 0;     ///< R_f
  double surface_rate = 0;  ///< R_s
  double samples_per_chart = 250;
  std::uint32_t most_faces_per_chart = 4000;
  FlattenOptions flatten;
  Parallel parallel;
};

/// A stage: begin, step until done, finish. Results: 8 bytes a face for the atlas and 8 bytes a vertex of each chart
/// for its map. Scratch: 36 bytes a face, and what one chart needs.
class MakeAtlas {
 public:
  Status begin(const Surface& surface, const AtlasOptions& options, Arena& arena);
  /// A piece of the partition or of a split, or a try at one chart; with threads at as many as find room in what is
  /// free, 8 at most.
  Status step(Arena& arena);
  bool done() const { return regions_.empty(); }
  double share_done() const { return regions_.share_taken(); }
  /// Numbers the charts in the order of their faces, adds line_seam to the edges between them, and gives scratch back.
  /// `atlas.place` is left empty: who needs it calls `index_places`.
  Status finish(Surface& surface, Atlas& atlas, ChartMaps& maps, Arena& arena);

 private:
  /// A try at a map for a region. The map is scratch.
  struct Try {
    Span<const FaceId> faces;
    bool is_good = false;
    Span<Vec2f> uv;
  };
  bool is_too_large(Span<const FaceId> faces) const;
  Status find_map(Try& attempt, Arena& arena) const;
  std::size_t reserve() const;
  Status keep_map(Span<const Vec2f> uv, Arena& arena);
  Status take_or_split(const Try& attempt, Arena& arena);

  const Surface* surface_ = nullptr;
  AtlasOptions options_;
  Span<std::uint32_t> label_;
  Span<FaceId> order_;
  Span<std::uint32_t>
      place_;       // of the chart that is tried; of the first face of one that is done: where its map begins
  Span<Vec2f> uv_;  // of the charts that are done, one after the other
  Regions regions_;
  ArenaMark mark_;
  std::uint32_t chart_count_ = 0;
};

}  // namespace v1
}  // namespace isolod
