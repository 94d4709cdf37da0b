// The narrated order of the stages: from the caller's triangles to the first mesh.
#include "mesh/validate.h"
#include "pipeline/chart_stage.h"
#include "pipeline/stage_hashes.h"
#include "pipeline/state.h"
#include "relax/worst_faces.h"
#include "result/lift.h"
#include "sample/lloyd_line.h"

namespace isolod {
inline namespace v1 {

namespace {

using State = Remesher::State;

/// Lines are sampled anew at each level, and what is beside them keeps little of the level before.
constexpr std::uint32_t least_first_count = 500, least_first_with_lines = 2000;
constexpr double refine_limit = 1.25;  // wished edge lengths

std::uint64_t face_units(const State& s) { return s.surface.mesh.face_count(); }

Status step_repair(State& s, bool& done, std::uint64_t& units) {
  units = s.view.triangle_count + s.view.vertex_count;
  if (!s.stage_begun) return s.repair.begin(s.view, s.options.weld, *s.arena);
  if (!s.repair.done()) return s.repair.step();
  done = true;
  return s.repair.finish(s.repaired, s.report.repair, *s.arena);
}

Status step_halfedge(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  Halfedges& mesh = s.surface.mesh;
  if (!s.stage_begun) {
    s.surface.view = &s.view;
    s.surface.source_vertex = s.repaired.source_vertex;
    s.surface.source_face = s.repaired.source_triangle;
    mesh.origin = s.repaired.triangles;
    return s.connect.begin(mesh, s.repaired.source_vertex.count, *s.arena);
  }
  if (!s.connect.done()) {
    s.connect.step(mesh, *s.arena);
    return {};
  }
  Topology topology;
  ISOLOD_TRY(measure_topology(mesh, topology, *s.arena));
  s.report.components = static_cast<std::uint32_t>(topology.components);
  s.report.boundary_loops = static_cast<std::uint32_t>(topology.boundary_loops);
  units = face_units(s);
  done = true;
  return {};
}

Status step_features(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  if (!s.stage_begun) {
    return s.features.begin(s.surface, {s.options.feature_angle, s.options.corner_angle}, *s.arena);
  }
  ISOLOD_TRY(s.features.step(s.surface, *s.arena));
  done = s.features.done();
  return {};
}

Status step_density(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  if (!s.stage_begun) {
    DensityOptions options{s.options.density, s.options.gamma, s.options.smoothing_passes};
    if (s.options.smooth_undersampled) {
      const std::uint32_t least = undersampling_passes(s.surface.mesh.vertex_count(), s.options.vertex_count);
      if (options.smoothing_passes < least) options.smoothing_passes = least;
    }
    ISOLOD_TRY(s.density.begin(s.surface, options, *s.arena));
  } else {
    s.density.step(s.surface, *s.arena);
  }
  done = s.density.done();
  return {};
}

/// Fewer samples than this cannot hold the surface together: its corners, three a loop, four a component.
std::uint64_t least_budget(const State& s, const DensityIntegrals& integrals) {
  return integrals.corner_count + 3 * std::uint64_t{s.report.boundary_loops} + 4 * std::uint64_t{s.report.components};
}

std::int64_t handles_of(const State& s, const DensityIntegrals& integrals) {
  const std::int64_t closed = std::int64_t{integrals.euler_characteristic} + s.report.boundary_loops;
  return s.report.components - closed / 2;
}

/// A first mesh that charts can surely hold, whatever the budget: what is too many is thinned out. It does not depend
/// on the budget, so that neither does the least that thinning comes to; bounded, since memory is planned from counts
/// alone.
std::uint32_t ample_count(const State& s, const DensityIntegrals& integrals) {
  const std::int64_t handles = handles_of(s, integrals);
  const std::int64_t wanted = 240 + 60 * (s.report.components + handles) + 12 * std::int64_t{s.report.boundary_loops} +
                              4 * std::int64_t{integrals.corner_count};
  const std::int64_t most = static_cast<std::int64_t>(most_first_count(s.view.triangle_count));
  return static_cast<std::uint32_t>(wanted < most ? wanted : most);
}

}  // namespace

LevelPlan plan_of(const State& s, std::uint32_t most_splits) {
  const DensityIntegrals& integrals = s.integrate.integrals();
  const std::int64_t handles = handles_of(s, integrals);
  const std::int64_t least =
      (integrals.lines > 0 ? least_first_with_lines : least_first_count) + 30 * (s.report.components + handles);
  LevelPlan plan = plan_levels(integrals, s.options.vertex_count, most_splits, static_cast<std::uint32_t>(least));
  const std::uint32_t ample = ample_count(s, integrals);
  if (s.options.remove_seams && plan.first_count < ample) plan.first_count = ample;
  return plan;
}

namespace {

/// Plans at most so many splits, and what the first mesh is made of.
void plan_run(State& s, const DensityIntegrals& integrals, std::uint32_t most_splits) {
  s.plan = plan_of(s, most_splits);
  s.first_rates = solve_rates(integrals, s.plan.first_count, s.options.calibration);
}

/// The rates that the integrals come to, and what the run is made of.
Status set_rates(State& s) {
  const DensityIntegrals& integrals = s.integrate.integrals();
  s.report.corners = integrals.corner_count;
  s.rates = solve_rates(integrals, s.options.vertex_count, s.options.calibration);
  plan_run(s, integrals, s.options.remove_seams ? LevelPlan::most_splits : 0);
  if (s.plan.first_count > s.options.vertex_count && !(s.rates.line > 0)) s.rates = s.first_rates;
  if (s.rates.line > 0 && s.first_rates.line > 0) return {};
  return fail(Status::budget_too_small, Element::count, least_budget(s, integrals));
}

Status step_calibrate(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  s.integrate.step(s.surface);
  done = s.integrate.done();
  return done ? set_rates(s) : Status();
}

/// Closes what the rates are too coarse for, and calibrates again: area, boundary and topology are others then.
Status step_close(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  if (!s.options.close_boundaries || s.report.boundary_loops == 0) {
    done = true;
    return {};
  }
  if (!s.stage_begun) {
    ISOLOD_TRY(s.close.begin(s.surface, {s.rates.line, s.options.corner_angle}, *s.arena));
    s.close.replace_from(s.repaired.behind_vertices);
    return {};
  }
  if (!s.close.done()) {
    ISOLOD_TRY(s.close.step(s.surface, *s.arena));
    done = s.close.done() && s.close.loops().closed == 0;
    if (s.close.done() && !done) s.integrate = IntegrateDensity();
    return {};
  }
  s.integrate.step(s.surface);
  done = s.integrate.done();
  if (!done) return {};
  s.report.closed_loops = s.close.loops().closed;
  s.report.boundary_loops -= s.report.closed_loops;
  return set_rates(s);
}

Status step_refine(State& s, bool& done, std::uint64_t& units) {
  if (!s.stage_begun) {
    ISOLOD_TRY(s.refine.begin(s.surface, greater(s.rates.line, s.first_rates.line), refine_limit, *s.arena));
    s.refine.replace_from(s.repaired.behind_vertices);
  }
  ISOLOD_TRY(s.refine.step(s.surface, *s.arena));
  units = elements_a_piece;
  done = s.refine.done();
  return {};
}

Status step_atlas(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  if (!s.stage_begun) {
    s.before_atlas = s.arena->mark();
    ChartingOptions options;
    options.kind = s.options.atlas;
    options.single.kind = s.options.cut;
    options.fall_back_to_charts = s.options.fall_back_to_charts;
    options.atlas.line_rate = s.first_rates.line;
    options.atlas.surface_rate = s.first_rates.surface;
    options.atlas.parallel = parallel_of(s);
    return s.charting.begin(s.surface, options, *s.arena);
  }
  if (!s.charting.done()) {
    s.stage_share = s.charting.share_done();
    return s.charting.step(s.surface, *s.arena);
  }
  done = true;
  units = face_units(s);
  ISOLOD_TRY(s.charting.finish(s.surface, s.atlas, s.maps, *s.arena));
  s.report.charts = static_cast<std::uint32_t>(s.atlas.chart_count());
  s.report.fallen_back = s.charting.fallen_back();
  return {};
}

/// Back to where the first mesh begins.
void restart(State& s) {
  s.arena->rewind_results(s.before_atlas);
  s.arena->rewind_scratch(s.before_atlas);
  for (std::uint8_t& l : s.surface.line) l = l & line_feature;
  s.sizes = {};
  s.next_stage = atlas_stage;
}

/// A first mesh that its charts cannot hold is made larger, and thinned out more, as often as there is room for it.
bool restart_larger(State& s, std::uint64_t least) {
  const std::uint64_t count = s.plan.first_count, larger = count + count / 4 + 1;
  const std::uint64_t next = least > larger ? least : larger;
  if (!s.options.remove_seams || next > most_first_count(s.view.triangle_count)) return false;
  s.plan.first_count = static_cast<std::uint32_t>(next);
  s.first_rates = solve_rates(s.integrate.integrals(), s.plan.first_count, s.options.calibration);
  restart(s);
  return true;
}

/// Too coarse a first mesh does not resolve the shape: its stars fold up. All is done again from a finer one.
void restart_finer(State& s) {
  plan_run(s, s.integrate.integrals(), s.plan.splits - 1);
  restart(s);
}

Status sample_all_lines(State& s, bool& done) {
  const std::uint64_t budget = s.plan.first_count, nodes = s.backbones.node.count;
  const std::uint32_t room = budget > nodes ? static_cast<std::uint32_t>(budget - nodes) : 0;
  Status status = sample_lines(s.surface, s.backbones, s.first_rates.line, room, s.lines, *s.arena);
  if (status == Status::budget_too_small) status.value += nodes;
  if (status.is_ok() && nodes > budget) status = fail(Status::budget_too_small, Element::count, nodes);
  if (status != Status::budget_too_small) return status;
  if (s.plan.splits > 0) {
    restart_finer(s);
  } else if (!restart_larger(s, status.value)) {
    return status;
  }
  done = true;
  return {};
}

Status step_lines(State& s, bool& done, std::uint64_t& units) {
  units = face_units(s);
  switch (s.piece++) {
    case 0:
      return trace_backbones(s.surface, s.backbones, *s.arena);
    case 1:
      if (s.options.calibration == Calibration::paper) {
        DensityIntegrals integrals = integrate_density(s.surface);  // once more: now with the seams
        integrals.corner_count = static_cast<std::uint32_t>(s.backbones.node.count);
        s.first_rates = solve_rates(integrals, s.plan.first_count, s.options.calibration);
      }
      return sample_all_lines(s, done);
    default:
      s.numbers = {static_cast<std::uint32_t>(s.backbones.node.count), static_cast<std::uint32_t>(s.lines.place.count)};
      done = true;
      return relax_lines(s.surface, s.backbones, s.lines, s.options.weight, default_line_iterations, *s.arena);
  }
}

/// What the first mesh is made of. A node where a seam meets a feature is the feature's.
void count_samples(State& s) {
  Report& report = s.report;
  report.backbones = static_cast<std::uint32_t>(s.backbones.count());
  report.surface_samples = static_cast<std::uint32_t>(s.places.count);
  report.feature_samples = 0;
  for (std::uint8_t h : s.samples.held) report.feature_samples += h != hold_none;
  report.seam_samples = s.plan.first_count - report.feature_samples - report.surface_samples;
}

Status begin_diffusion(State& s) {
  const std::uint32_t surface_samples = s.plan.first_count - s.numbers.node_count - s.numbers.line_count;
  ISOLOD_TRY(s.arena->result(surface_samples, s.places));
  ISOLOD_TRY(s.arena->result(s.atlas.chart_count() + 1, s.chart_start));
  s.before_diffuse = s.arena->mark();
  ISOLOD_TRY(s.arena->scratch(s.surface.mesh.face_count(), s.face_count));
  return s.diffuse.begin(
      {&s.surface, &s.backbones, &s.lines, s.first_rates.surface, surface_samples, s.options.fluency}, s.face_count,
      *s.arena);
}

Status step_diffuse(State& s, bool& done, std::uint64_t& units) {
  units = elements_a_piece;
  if (!s.stage_begun) return begin_diffusion(s);
  if (!s.diffuse.done()) {
    s.stage_share = s.diffuse.share_done();
    return s.diffuse.step(*s.arena);
  }
  done = true;
  units = face_units(s);
  const FluencyReport flow = s.diffuse.finish(*s.arena);
  s.report.diffusion = {flow.fluency, flow.largest_received, flow.teleports, flow.split_faces};
  place_samples(s.surface, {s.atlas.faces, s.atlas.start}, s.face_count, s.chart_start, s.places);
  s.arena->rewind_scratch(s.before_diffuse);
  if (s.atlas.place.empty()) ISOLOD_TRY(index_places(s.atlas, *s.arena));
  return index_edges(s.surface, s.backbones, *s.arena);
}

Status step_stitch(State& s, bool& done, std::uint64_t& units) {
  units = s.options.vertex_count;
  if (s.piece++ == 0) {
    const Status status = s.stitch.finish(*s.arena);
    done = status == Status::invalid_result && s.plan.splits == 0 && restart_larger(s, 0);
    return done ? Status() : status;
  }
  done = true;
  ISOLOD_TRY(gather_samples(s.sampled(), s.samples, *s.arena));
  count_samples(s);
  return {};
}

bool is_thinned(const State& s) { return s.plan.splits == 0 && s.plan.is_thinned(); }

WorstFacesOptions polish_options(const State& s) {
  const bool is_few = is_thinned(s) && 4 * std::uint64_t{s.options.vertex_count} < s.plan.first_count;
  return is_few ? WorstFacesOptions::for_few() : WorstFacesOptions();
}

/// What the first mesh was made of goes: from here on only the surface and the mesh are needed.
void keep_first_mesh(State& s) {
  Triangulation& mesh = s.stitch.mesh();
  ArenaMark to = s.before_atlas;
  s.arena->move_down(mesh.mesh.origin, mesh.mesh.origin.count, to);
  s.arena->move_down(mesh.mesh.twin, mesh.mesh.twin.count, to);
  s.arena->move_down(mesh.fixed, mesh.fixed.count, to);
  s.arena->move_down(mesh.mesh.outgoing, mesh.mesh.outgoing.count, to);
  move_down(s.samples, s.samples.count(), to, *s.arena);
  s.arena->rewind_results(to);
  s.atlas = {};
  s.maps = {};
  s.backbones = {};
  s.lines = {};
  s.places = {};
  s.chart_start = {};
}

/// The level before goes, and what its levels of detail were made of.
void keep_level(State& s) {
  ArenaMark to = s.before_atlas;
  s.levels.move_features(to, *s.arena);
  s.lods.move_results(to, *s.arena);
  s.levels.move_mesh(to, *s.arena);
  s.arena->rewind_results(to);
}

/// Samples that the first mesh has over its budget are taken out again.
Status step_thin(State& s, bool& done, std::uint64_t& units) {
  if (!s.stage_begun && s.options.remove_seams) keep_first_mesh(s);
  units = 100;
  done = !is_thinned(s);
  if (done) return {};
  if (!s.stage_begun) {
    s.before_thin = s.arena->mark();
    ThinOptions options;
    options.target_count = s.options.vertex_count;
    options.lines_alike = true;
    return s.thin.begin(s.surface, options, s.stitch.mesh(), s.samples, *s.arena);
  }
  if (!s.thin.done()) {
    s.thin.step();
    return {};
  }
  units = face_units(s);
  done = true;
  ISOLOD_TRY(s.thin.finish(*s.arena));
  s.arena->rewind_scratch(s.before_thin);
  s.is_thinnest = s.samples.count() > s.options.vertex_count;
  if (s.is_thinnest) return fail(Status::budget_too_small, Element::count, s.samples.count());
  WorstFacesOptions options = polish_options(s);
  options.resettles = false;
  return improve_worst_faces(s.surface, nullptr, options, s.stitch.mesh(), s.samples, *s.arena);
}

Status step_levels(State& s, bool& done, std::uint64_t& units) {
  if (!s.options.remove_seams) {
    done = true;
    return {};
  }
  if (!s.stage_begun) {
    LevelOptions options;
    options.line_rate = s.rates.line;
    options.weight = s.options.weight;
    options.parallel = parallel_of(s);
    s.levels.begin(s.plan, options);
    s.lods.begin(s.coarser, s.integrate.integrals(), s.options, options.parallel);
  }
  units = elements_a_piece;
  if (!s.lods.done()) return s.lods.step(s.surface, *s.arena);
  done = s.levels.done();
  if (done) return {};
  ISOLOD_TRY(s.levels.step(s.surface, s.stitch.mesh(), s.samples, *s.arena));
  s.stage_share = s.levels.share_done();
  if (s.levels.is_level_begin()) keep_level(s);
  if (s.levels.is_level_end() || s.levels.done()) return s.lods.branch(s.stitch.mesh(), s.samples, *s.arena);
  if (!s.levels.is_unresolved()) return {};
  restart_finer(s);
  done = true;
  return {};
}

Status step_lift(State& s, bool& done, std::uint64_t& units) {
  units = s.options.vertex_count;
  if (!s.stage_begun) {
    const Backbones* features = s.options.remove_seams ? s.levels.features() : nullptr;
    const bool has_features = s.options.feature_angle > 0;
    s.finish.begin({s.options.remove_seams, s.options.fit, has_features, polish_options(s), features});
  }
  ISOLOD_TRY(s.finish.step(s.surface, s.stitch.mesh(), s.samples, *s.arena));
  done = s.finish.done();
  return {};
}

Status step_validate(State& s, bool& done, std::uint64_t& units) {
  units = s.options.vertex_count;
  done = true;
#if !defined(ISOLOD_CHECKED)
  if (!s.options.validate) return {};
#endif
  Finding finding;
  ISOLOD_TRY(find_defect(s.finish.triangles, s.finish.positions, s.options.vertex_count, finding, *s.arena));
  if (finding.defect == Defect::none) return {};
  return fail(Status::invalid_result, Element::vertex, finding.element);
}

}  // namespace

const StageEntry stage_entries[] = {
    {"repair", step_repair, hash_repaired, 0.05},    {"halfedge", step_halfedge, hash_surface, 0.02},
    {"features", step_features, hash_lines, 0.02},   {"density", step_density, hash_density, 0.02},
    {"calibrate", step_calibrate, hash_rates, 0.01}, {"close", step_close, hash_closed, 0.01},
    {"refine", step_refine, hash_surface, 0.02},     {"atlas", step_atlas, hash_atlas, 0.4},
    {"lines", step_lines, hash_line_samples, 0.01},  {"diffuse", step_diffuse, hash_places, 0.02},
    {"charts", step_charts, hash_places, 0.4},       {"stitch", step_stitch, hash_samples, 0.02},
    {"thin", step_thin, hash_samples, 0.01},         {"levels", step_levels, hash_samples, 0.5},
    {"lift", step_lift, hash_result, 0.05},          {"validate", step_validate, hash_result, 0.01},
};
const std::uint32_t stage_entry_count = sizeof stage_entries / sizeof stage_entries[0];

}  // namespace v1
}  // namespace isolod
