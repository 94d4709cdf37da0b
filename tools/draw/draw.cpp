#include "draw/draw.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>

#include "draw/chart_pictures.h"
#include "draw/surface_pictures.h"
#include "pipeline/state.h"

namespace draw {

namespace {

using isolod::Remesher;
using isolod::Status;

constexpr std::size_t most_bytes = std::size_t{1} << 32, most_chart_bytes = std::size_t{1} << 29;

/// A block for an arena. Memory that is not written costs nothing, so it may be large; where it cannot be had, half of
/// it may do.
struct Block {
  explicit Block(std::size_t wished) : count(wished) {
    bytes.reset(new (std::nothrow) unsigned char[count]);
    while (bytes == nullptr && count > 0) bytes.reset(new (std::nothrow) unsigned char[count /= 2]);
  }
  isolod::Arena arena() const { return isolod::Arena(bytes.get(), count); }

  std::unique_ptr<unsigned char[]> bytes;
  std::size_t count;
};

/// Draws while a run goes on: `look` after every slice.
class Artist {
 public:
  Artist(const std::string& folder, const PictureSettings& settings, std::size_t block_bytes, PictureOutcome& outcome)
      : folder_(folder), settings_(settings), block_bytes_(block_bytes), outcome_(outcome) {}

  Status look(const Remesher::State& state) {
    const std::uint32_t ended = state.stage;
    if (ended == looked_ || state.stage_begun) return {};
    looked_ = ended;
    const char* const stage = isolod::stage_entries[ended - 1].name;
    if (std::strcmp(stage, "features") == 0) return draw_first(state);
    if (std::strcmp(stage, "diffuse") == 0) return draw_middle(state);
    return {};
  }

  /// Also of a run that failed in its last checks.
  Status draw_last(const Remesher::State& state) {
    const Model result = model_of(state.positions, state.triangles);
    if (result.face.empty()) return {};
    ISOLOD_TRY(keep("5_result.svg", draw_result(path("5_result.svg"), frame_, result)));
    return keep("6_valence.svg", draw_valence(path("6_valence.svg"), frame_, result));
  }

 private:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  Status keep(const std::string& name, bool is_written) {
    if (is_written) {
      if (!is_kept(path(name))) outcome_.files.push_back(path(name));
      return {};
    }
    outcome_.unwritten = path(name);
    return Status::cannot_open;
  }

  bool is_kept(const std::string& file) const {
    return std::find(outcome_.files.begin(), outcome_.files.end(), file) != outcome_.files.end();
  }

  /// A run may begin again with more samples; its charts are others then.
  void forget_charts() {
    const std::string prefix = path("4_chart_");
    const auto is_old = [&](const std::string& file) {
      const bool is_chart = file.compare(0, prefix.size(), prefix) == 0;
      if (is_chart) std::remove(file.c_str());
      return is_chart;
    };
    outcome_.files.erase(std::remove_if(outcome_.files.begin(), outcome_.files.end(), is_old), outcome_.files.end());
  }

  Status draw_first(const Remesher::State& state) {
    frame_ = make_frame(state.surface, settings_);
    return keep("1_original.svg", draw_original(path("1_original.svg"), frame_, state.surface));
  }

  Status draw_middle(const Remesher::State& state) {
    const isolod::SampledSurface samples = state.sampled();
    forget_charts();
    ISOLOD_TRY(keep("2_charts.svg", draw_charts(path("2_charts.svg"), frame_, state.surface, state.atlas)));
    ISOLOD_TRY(keep("3_samples.svg", draw_samples(path("3_samples.svg"), frame_, samples, state.options.vertex_count)));
    const std::size_t largest = greatest_chart(state, false), featured = greatest_chart(state, true);
    ISOLOD_TRY(draw_chart_of(state, largest));
    return featured == largest ? Status() : draw_chart_of(state, featured);
  }

  Status draw_chart_of(const Remesher::State& state, std::size_t chart) {
    const Block block(std::min(block_bytes_, most_chart_bytes));
    isolod::Arena arena = block.arena();
    ChartStory story;
    // A chart that cannot be triangulated is drawn as far as it goes; the run itself will report it.
    (void)tell_story(state.sampled(), state.uv, chart, state.options, arena, story);
    const std::string name = "4_chart_" + std::to_string(chart) + ".svg";
    return keep(name, draw_chart(path(name), chart, story, state.options.lloyd_iterations));
  }

  /// The chart of the most area, or of the longest feature lines.
  static std::size_t greatest_chart(const Remesher::State& state, bool by_features) {
    const isolod::Surface& surface = state.surface;
    std::vector<double> size(state.atlas.chart_count(), 0.0);
    for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(surface.mesh.halfedge_count())) {
      double& sum = size[state.atlas.chart_of_face[face(h)]];
      const bool is_feature = (surface.line[h] & isolod::line_feature) != 0;
      if (by_features)
        sum += is_feature ? edge_length(surface, h) : 0;
      else if (h.value % 3 == 0)
        sum += face_area(surface, face(h));
    }
    std::size_t greatest = 0;
    for (std::size_t c = 0; c < size.size(); ++c) greatest = size[c] > size[greatest] ? c : greatest;
    return by_features && !(size[greatest] > 0) ? greatest_chart(state, false) : greatest;
  }

  std::string folder_;
  PictureSettings settings_;
  std::size_t block_bytes_;
  PictureOutcome& outcome_;
  Frame frame_;
  std::uint32_t looked_ = 0;
};

}  // namespace

PictureOutcome draw_run(const std::string& folder, const isolod::MeshView& view, const isolod::Options& options,
                        const PictureSettings& settings) {
  PictureOutcome outcome;
  const std::size_t required = isolod::required_memory(view.vertex_count, view.triangle_count, options);
  const std::size_t plenty = std::min(4 * required, most_bytes);
  const Block block(settings.block_bytes != 0 ? settings.block_bytes : plenty);
  isolod::Arena arena = block.arena();
  Artist artist(folder, settings, block.count, outcome);
  Remesher remesher;
  outcome.status = remesher.begin(view, options, {}, arena);
  while (outcome.status.is_ok() && !remesher.done()) {
    outcome.status = remesher.advance(0);  // one piece
    if (outcome.status.is_ok()) outcome.status = artist.look(*remesher.state());
  }
  if (remesher.state() == nullptr || outcome.status == Status::cannot_open) return outcome;
  const Status drawn = artist.draw_last(*remesher.state());
  if (outcome.status.is_ok()) outcome.status = drawn;
  return outcome;
}

}  // namespace draw
