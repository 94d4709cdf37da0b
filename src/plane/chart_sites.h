// The constrained Delaunay triangulation of one chart's samples, grown out of its flattened mesh.
//
// Paper, section 4.3. The samples are put into the flattened mesh itself, line samples on the edges that carry them and
// the others by walking; then the original vertices that are no samples are taken out again, inner ones first, so that
// the chords between samples take the place of the lines. Everything is local: an overlap of the map does no harm, and
// the result is a manifold with the chart's topology even where a chord leaves the domain.
#pragma once

#include "atlas/chart.h"
#include "base/sweep.h"
#include "plane/delaunay.h"
#include "plane/flatten.h"
#include "sample/line_samples.h"
#include "sample/place.h"

namespace isolod {
inline namespace v1 {

/// All samples of a run by number: nodes first, then those on lines, backbone by backbone, then those on faces.
struct SampleNumbers {
  std::uint32_t node_count = 0;
  std::uint32_t line_count = 0;

  SampleId of_node(std::uint32_t node) const { return {node}; }
  SampleId of_line(std::uint32_t line_sample) const { return {node_count + line_sample}; }
  SampleId of_surface(std::uint32_t surface_sample) const { return {node_count + line_count + surface_sample}; }
};

/// What a chart's samples are made of.
struct SampledSurface {
  const Surface* surface;
  const Atlas* atlas;
  const Backbones* backbones;
  const LineSamples* lines;
  Span<const SurfacePlace> places;
  Span<const std::uint32_t> chart_start;  ///< per chart, one more at the end: its part of `places`
  SampleNumbers numbers;
};

/// The maps of an atlas. Rounded to 32 bits for charts of little stretch: a place per local vertex (chart.h), chart by
/// chart. Exact for whole components: a place per halfedge, that of its origin in the chart of its face. Rounded ones
/// are per halfedge too where there is no `start`.
struct ChartMaps {
  Span<Vec2f> rounded;
  Span<std::uint32_t> start;  ///< per chart: its part of `rounded`
  Span<Vec2> exact;

  ChartMaps() = default;
  ChartMaps(Span<Vec2f> uv) : rounded(uv) {}  // NOLINT: a map is a map
  /// Of a local vertex of a chart, where a halfedge of the surface begins.
  Vec2 at(std::size_t chart, VertexId local, HalfedgeId h) const {
    if (!exact.empty()) return exact[h];
    return widen(start.empty() ? rounded[h] : rounded[start[chart] + local.value]);
  }
};

/// The flattened chart: what samples are located in.
struct FlatChart {
  Chart chart;
  Span<Vec2> uv;               ///< per local vertex
  Span<std::uint8_t> barrier;  ///< per local halfedge: the bits of its line, 0 elsewhere
};

struct ChartSites {
  PlaneTriangulation plane;
  Span<SampleId> sample;    ///< per vertex
  Span<FaceId> home;        ///< per vertex: a local face of the flat chart near it, where walks begin
  std::uint32_t stuck = 0;  ///< original vertices that could not be taken out
};

/// The scratch of `build_flat_chart` and `GrowSites` for a chart of so many faces and samples, those on its border
/// included.
std::size_t chart_sites_bytes(std::size_t face_count, std::size_t vertex_count, std::size_t sample_count);

/// Builds the local chart and its map. Scratch stays with the caller's scope.
Status build_flat_chart(const Surface& surface, const Atlas& atlas, const ChartMaps& maps, std::size_t chart,
                        FlatChart& flat, Arena& arena);

/// A stage: begin, step until done, finish. Grows the triangulation of one chart's samples. O(n) time in practice.
class GrowSites {
 public:
  /// Puts the samples in. Scratch of about 150 bytes a local face and 100 a sample stays with the caller's scope, and
  /// `flat` and `sites` must outlive the stage.
  Status begin(const SampledSurface& samples, const FlatChart& flat, std::size_t chart, ChartSites& sites,
               Arena& arena);
  /// Tries to take out the next `originals_a_step` original vertices.
  void step();
  bool done() const { return done_; }
  /// no_convergence, with how many, where original vertices could not be taken out.
  Status finish(Arena& arena);

  static constexpr std::size_t originals_a_step = 512;

 private:
  /// The line samples on an edge of the skeleton are contiguous: [first, last) in LineSamples::place.
  struct Range {
    std::uint32_t first, last;
  };
  std::uint32_t line_place(HalfedgeId local) const;
  Range samples_on(std::uint32_t edge) const;
  std::size_t count_line_samples() const;
  void copy_chart();
  VertexId add_vertex(Vec2 p, SampleId sample, FaceId home);
  void put_on_edge(HalfedgeId h);
  void put_line_samples();
  void put_in_face(FaceId local, const SurfacePlace& place, SampleId sample);
  Vec2 strictly_inside(FaceId f, Vec2 p) const;
  void put_surface_samples();
  bool is_on_line(VertexId v) const;
  void try_to_take_out(VertexId v);

  SampledSurface samples_{};
  const FlatChart* flat_ = nullptr;
  ChartSites* sites_ = nullptr;
  PlaneTriangulation* plane_ = nullptr;  // of the sites
  EdgeStack stack_;
  std::uint32_t first_place_ = 0, last_place_ = 0, vertex_count_ = 0;
  Sweep sweep_;
  bool on_lines_ = false;   // which original vertices this pass tries
  std::uint32_t stay_ = 0;  // of this round, which is a pass over either kind
  bool done_ = false;
};

/// The whole stage at once.
Status triangulate_sites(const SampledSurface& samples, const FlatChart& flat, std::size_t chart, ChartSites& sites,
                         Arena& arena);

}  // namespace v1
}  // namespace isolod
