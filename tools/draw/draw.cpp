#include "draw/draw.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "draw/chart_pictures.h"
#include "draw/staged_run.h"
#include "draw/surface_pictures.h"

namespace draw {

namespace {

using isolod::Remesher;
using isolod::Status;

constexpr std::size_t most_chart_bytes = std::size_t{1} << 29;

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
    const Model result = model_of(state.finish.positions, state.finish.triangles);
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
    const std::size_t largest = greatest_chart(state.surface, state.atlas, false),
                      featured = greatest_chart(state.surface, state.atlas, true);
    ISOLOD_TRY(draw_chart_of(state, largest));
    return featured == largest ? Status() : draw_chart_of(state, featured);
  }

  Status draw_chart_of(const Remesher::State& state, std::size_t chart) {
    const Block block(std::min(block_bytes_, most_chart_bytes));
    isolod::Arena arena = block.arena();
    ChartStory story;
    // A chart that cannot be triangulated is drawn as far as it goes; the run itself will report it.
    (void)tell_story(state.sampled(), state.maps, chart, state.options, {0, state.options.lloyd_iterations}, arena,
                     story);
    const std::string name = "4_chart_" + std::to_string(chart) + ".svg";
    return keep(name, draw_chart(path(name), chart, story));
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
  StagedRun run(view, options, settings.block_bytes);
  Artist artist(folder, settings, run.block_bytes(), outcome);
  do {
    outcome.status = run.advance();
    if (outcome.status.is_ok()) outcome.status = artist.look(*run.state());
  } while (outcome.status.is_ok() && !run.done());
  if (run.state() == nullptr || outcome.status == Status::cannot_open) return outcome;
  const Status drawn = artist.draw_last(*run.state());
  if (outcome.status.is_ok()) outcome.status = drawn;
  return outcome;
}

}  // namespace draw
