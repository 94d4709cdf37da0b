#include "pipeline/memory_plan.h"

#include "base/array_bytes.h"
#include "base/environment.h"
#include "mesh/validate.h"
#include "relax/insert.h"
#include "relax/line_counts.h"
#include "result/feature_lines.h"

namespace isolod {
inline namespace v1 {

namespace {

using State = Remesher::State;

/// What a chart, or several one after the other, is made of.
struct ChartSizes {
  std::uint32_t border = 0;   // sides towards other charts, cuts and boundaries
  std::uint32_t samples = 0;  // on its lines, those on both sides of a cut twice
};

void add_lines(const State& s, Span<ChartSizes> charts) {
  const Halfedges& mesh = s.surface.mesh;
  const auto chart_of = [&](HalfedgeId h) -> ChartSizes& { return charts[s.atlas.chart_of_face[face(h)]]; };
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    chart_of(h).border += mesh.is_boundary(h) || (s.surface.line[h] & line_seam) != 0;
  }
  for (const LinePlace& place : s.lines.place) {
    const HalfedgeId h = s.backbones.edge[place.edge], t = mesh.twin[h];
    ++chart_of(h).samples;
    if (!t.is_none()) ++chart_of(t).samples;
  }
}

std::size_t chart_bytes(const State& s, std::size_t chart, const ChartSizes& sizes) {
  const std::size_t faces = s.atlas.start[chart + 1] - s.atlas.start[chart];
  const std::size_t vertices = 1 + (faces + sizes.border) / 2;
  const std::size_t samples = sizes.samples + s.chart_start[chart + 1] - s.chart_start[chart];
  const std::size_t sites = samples + sizes.border;  // every vertex on a line may be a node
  return chart_sites_bytes(faces, vertices, samples) + Lloyd::bytes(faces, sites, 2 * sites);
}

/// Lines that are features, not seams. A backbone has an edge at least, and all of them may be one.
LineSizes feature_sizes(const State& s) {
  const Halfedges& mesh = s.surface.mesh;
  LineSizes lines;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const bool is_feature = (s.surface.line[h] & line_feature) != 0;
    lines.edges += is_feature && (mesh.is_boundary(h) || h < mesh.twin[h]);
  }
  const DensityIntegrals& integrals = s.integrate.integrals();
  lines.nodes = integrals.corner_count;
  lines.backbones = lines.longest = lines.edges;
  const double wished = 1.1 * s.rates.line * integrals.lines;
  lines.samples = static_cast<std::size_t>(wished) + lines.nodes + 3 * std::size_t{s.report.boundary_loops} + 64;
  return lines;
}

}  // namespace

Status measure_run(const State& s, RunSizes& sizes, Arena& arena) {
  sizes = {};
  sizes.sampled_bytes = arena.used();
  sizes.surface_bytes = s.before_atlas.front + s.before_atlas.back;
  sizes.face_count = s.surface.mesh.face_count();
  sizes.vertex_count = s.surface.mesh.vertex_count();
  sizes.first_count = s.plan.first_count;
  sizes.features = feature_sizes(s);
  const std::int64_t euler = s.integrate.integrals().euler_characteristic;
  sizes.handle_faces = euler < 0 ? static_cast<std::size_t>(-2 * euler) : 0;
  sizes.removes_seams = s.options.remove_seams;
  sizes.fits = s.options.fit;
  sizes.validates = s.options.validate;
#if defined(ISOLOD_CHECKED)
  sizes.validates = true;
#endif
  const ScratchScope scope(arena);
  Span<ChartSizes> charts;
  ISOLOD_TRY(arena.scratch(s.atlas.chart_count(), charts));
  for (ChartSizes& c : charts) c = {};
  add_lines(s, charts);
  for (std::size_t c = 0; c < charts.count; ++c)
    sizes.chart_bytes = most_of(sizes.chart_bytes, chart_bytes(s, c, charts[c]));
  return {};
}

namespace {

/// Adds up what the levels hold, one after the other.
class LevelSum {
 public:
  LevelSum(const RunSizes& sizes, const LevelPlan& plan, Span<const Lod> coarser)
      : sizes_(sizes), plan_(plan), coarser_(coarser) {}

  std::size_t faces(std::size_t samples) const { return 2 * samples + sizes_.handle_faces; }
  std::size_t held(std::size_t samples) const { return mesh_bytes(samples, faces(samples)) + samples_bytes(samples); }

  std::size_t features() const {
    if (sizes_.features.edges == 0) return 0;
    return backbones_bytes(sizes_.vertex_count, sizes_.features) + array_bytes<std::uint32_t>(3 * sizes_.face_count);
  }

  /// All levels: the most that is in use. `end` is what is in use behind the last.
  std::size_t run(std::size_t& end) {
    std::size_t mesh = held(plan_.first_count);
    std::size_t most = sizes_.surface_bytes + mesh + features() + array_bytes<std::uint8_t>(3 * sizes_.face_count);
    kept_ = sizes_.surface_bytes + features();
    for (std::uint32_t level = 0; level <= plan_.splits; ++level) {
      if (level > 0) most = most_of(most, split(level, mesh));
      const std::size_t room = level == 0 ? plan_.first_count : room_;
      most = most_of(most, kept_ + mesh + work(level, room));
      most = most_of(most, branch(level, mesh));
    }
    end = kept_ + mesh;
    return most;
  }

 private:
  /// Lines of a level: each has half as many samples as the next.
  LineSizes lines(std::uint32_t level) const {
    LineSizes lines = sizes_.features;
    if (lines.edges == 0) return {};
    for (std::uint32_t l = level; l < plan_.splits; ++l) lines.samples = lines.samples / 2 + lines.nodes + 64;
    return lines;
  }

  /// Thinning may get stuck above the wished number on a coarse level.
  std::size_t count(std::uint32_t level) const {
    return level == plan_.splits ? plan_.count[level] : plan_.count[level] + plan_.count[level] / 50;
  }

  std::size_t split(std::uint32_t level, std::size_t& mesh) {
    const std::size_t coarse = count(level - 1);
    const std::size_t fine = 4 * coarse + 3 * sizes_.handle_faces / 2, wished = plan_.count[level];
    const LineSizes before = lines(level - 1), now = lines(level);
    const std::size_t spare = (wished > fine ? wished - fine : 0) + (now.samples > 0 ? now.samples / 4 + 64 : 0);
    room_ = fine + spare;
    const std::size_t next = samples_bytes(room_) + mesh_bytes(room_, 4 * faces(coarse) + 2 * spare);
    const std::size_t counting = sample_lines_bytes(now) + riders_bytes(before);
    const std::size_t most = kept_ + mesh + most_of(counting, next + SplitEdges::bytes(faces(coarse), before));
    mesh = next;
    return most;
  }

  /// Of a level whose arrays have so much room.
  std::size_t work(std::uint32_t level, std::size_t room) const {
    const std::size_t samples = count(level);
    const LineSizes on = lines(level);
    std::size_t most = ThinOut::bytes(room, faces(room));
    if (on.edges > 0) {
      most = most_of(most, feature_lines_bytes(on));
      most = most_of(most, sample_lines_bytes(on) + match_line_bytes(on, room, faces(room)));
    }
    most = most_of(most, insert_bytes(faces(samples), 0));
    return most_of(most, relaxing(samples));
  }

  std::size_t relaxing(std::size_t samples) const {
    return most_of(WorstFaces::bytes(samples, faces(samples)),
                   Relaxation::bytes(sizes_.face_count, samples, faces(samples)));
  }

  std::size_t results(const Lod& lod) const {
    return array_bytes<double>(3 * std::size_t{lod.vertex_count}) +
           array_bytes<std::uint32_t>(3 * faces(lod.vertex_count));
  }

  /// The levels of detail that branch off: each is made from a copy of the level's mesh.
  std::size_t branch(std::uint32_t level, std::size_t mesh) {
    const std::size_t samples = count(level);
    std::size_t made = 0, most = 0, results_before = 0;
    for (const Lod& lod : coarser_) {
      const bool is_before = level > 0 && lod.vertex_count <= plan_.count[level - 1];
      if (is_before || lod.vertex_count > samples) continue;
      made += features() + results(lod);
      results_before += results(lod);
      const std::size_t smaller = lod.vertex_count;
      std::size_t work = most_of(ThinOut::bytes(samples, faces(samples)), relaxing(smaller));
      work = most_of(work, list_triangles_bytes(smaller, faces(smaller)));
      if (sizes_.features.edges > 0) work = most_of(work, feature_lines_bytes(sizes_.features));
      if (sizes_.fits) work = most_of(work, Fit::bytes(sizes_.face_count, smaller, faces(smaller)));
      most = most_of(most, work);
    }
    if (made == 0) return 0;
    most += kept_ + mesh + held(samples) + made;
    kept_ += results_before;
    return most;
  }

  const RunSizes& sizes_;
  const LevelPlan& plan_;
  Span<const Lod> coarser_;
  std::size_t kept_ = 0, room_ = 0;
};

}  // namespace

LateStages plan_late_stages(const RunSizes& sizes, const LevelPlan& levels, Span<const Lod> coarser) {
  LevelSum sum(sizes, levels, coarser);
  LateStages late;
  const std::size_t first = levels.first_count, more = first > sizes.first_count ? first - sizes.first_count : 0;
  const std::size_t sampled = sizes.sampled_bytes + array_bytes<SurfacePlace>(more);
  const std::size_t stitched = sampled + mesh_bytes(first, sum.faces(first));
  late.charts = stitched + sizes.chart_bytes;
  late.stitch = stitched + most_of(Stitch::bytes(first, sum.faces(first)), samples_bytes(first));
  late.thin = stitched + samples_bytes(first);
  std::size_t end = late.thin;
  if (sizes.removes_seams) {
    const std::size_t packed = sizes.surface_bytes + sum.held(first);
    const std::size_t work =
        most_of(ThinOut::bytes(first, sum.faces(first)), WorstFaces::bytes(first, sum.faces(first)));
    late.thin = most_of(late.thin, packed + work);
    late.levels = most_of(late.thin, sum.run(end));
  } else {
    late.levels = end;
  }
  const std::size_t samples = sizes.removes_seams ? levels.count[levels.splits] : first;
  const std::size_t faces = sum.faces(samples);
  const std::size_t points = array_bytes<double>(3 * samples), corners = array_bytes<std::uint32_t>(3 * faces);
  std::size_t work =
      most_of(WorstFaces::bytes(samples, faces), points + corners + list_triangles_bytes(samples, faces));
  if (sizes.fits) work = most_of(work, points + Fit::bytes(sizes.face_count, samples, faces));
  late.lift = end + work;
  late.validate = end + points + corners + (sizes.validates ? find_defect_bytes(samples, faces) : 0);
  return late;
}

namespace {

/// Of a block: it may begin and end where the arena cannot use the first and the last bytes.
constexpr std::size_t misfit = 2 * arena_alignment;

void raise_stage(MemoryPlan& plan, const char* name, std::size_t bytes) {
  std::size_t at = 0;
  while (at < plan.stage_count && plan.stages[at].name != name) ++at;
  if (at == plan.stage_count) plan.stages[plan.stage_count++] = {name, 0};
  plan.stages[at].bytes = most_of(plan.stages[at].bytes, bytes);
  plan.bytes = most_of(plan.bytes, plan.stages[at].bytes + misfit);
}

void raise_late(MemoryPlan& plan, const LateStages& late) {
  const std::size_t bytes[] = {late.charts, late.stitch, late.thin, late.levels, late.lift, late.validate};
  for (std::uint32_t i = 0; i < sizeof bytes / sizeof bytes[0]; ++i) {
    raise_stage(plan, stage_entries[charts_stage + i].name, bytes[i]);
  }
}

/// How much more the sampled surface takes where the run begins again from a finer first mesh: charts have a border of
/// twice the length for every split less, at most all edges.
std::size_t finer_bytes(const State& s, const LevelPlan& levels) {
  std::size_t border = s.backbones.edge.count;
  for (std::uint32_t k = levels.splits; k < s.plan.splits; ++k) border *= 2;
  const std::size_t edges = s.surface.mesh.halfedge_count() / 2;
  if (border > edges) border = edges;
  const std::size_t more = border > s.backbones.edge.count ? border - s.backbones.edge.count : 0;
  return 40 * more + 4 * sizeof(LinePlace) * (levels.first_count > s.plan.first_count ? more : 0);
}

/// What the charts cannot hold is made larger by a quarter: twice, that is. More often is not planned for.
std::uint32_t larger_count(const State& s, std::uint32_t count) {
  const std::size_t larger = count + count / 2 + count / 8, most = most_first_count(s.view.triangle_count);
  return larger < most || count > most ? static_cast<std::uint32_t>(count > most ? count : larger)
                                       : static_cast<std::uint32_t>(most);
}

/// The run as it is planned, and as it goes where it has to begin again with fewer splits, or with a larger first mesh.
void add_late_stages(const State& s, const RunSizes& sizes, Span<const Lod> coarser, MemoryPlan& plan) {
  raise_late(plan, plan_late_stages(sizes, s.plan, coarser));
  if (!s.options.remove_seams) return;
  for (std::uint32_t splits = s.plan.splits;; --splits) {
    LevelPlan levels = plan_of(s, splits);
    if (levels.first_count < s.plan.first_count) levels.first_count = s.plan.first_count;
    if (splits == 0) levels.first_count = larger_count(s, levels.first_count);
    RunSizes finer = sizes;
    const std::size_t more = finer_bytes(s, levels);
    finer.sampled_bytes += more;
    raise_late(plan, plan_late_stages(finer, levels, coarser));
    for (std::uint32_t i = atlas_stage; i < charts_stage; ++i) {
      const std::size_t places = array_bytes<SurfacePlace>(levels.first_count - s.plan.first_count);
      raise_stage(plan, stage_entries[i].name, s.report.stages[i].arena_bytes + more + places);
    }
    if (splits == 0) return;
  }
}

/// What has been measured, and what comes behind.
void add_stages(const State& s, const RunSizes& sizes, Span<const Lod> coarser, MemoryPlan& plan) {
  for (std::size_t i = 0; i < s.report.stage_count; ++i) {
    raise_stage(plan, s.report.stages[i].name, s.report.stages[i].arena_bytes);
  }
  add_late_stages(s, sizes, coarser, plan);
}

/// Runs up to the charts.
Status measure_and_plan(const MeshView& view, const Options& options, Span<const Lod> coarser, MemoryPlan& plan,
                        Arena& arena) {
  Remesher remesher;
  Status status = remesher.begin(view, options, {}, arena);
  while (status.is_ok() && remesher.state()->stage < charts_stage) status = remesher.advance(0);
  if (!status.is_ok()) return status;
  RunSizes sizes;
  ISOLOD_TRY(measure_run(*remesher.state(), sizes, arena));
  add_stages(*remesher.state(), sizes, coarser, plan);
  return {};
}

}  // namespace

Status plan_memory(const MeshView& view, const Options& options, Span<const Lod> coarser, MemoryPlan& plan,
                   Arena& arena) {
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  const ArenaMark mark = arena.mark();
  const std::size_t before = arena.used();
  plan = {};
  const Status status = measure_and_plan(view, options, coarser, plan, arena);
  arena.rewind_results(mark);
  arena.rewind_scratch(mark);
  if (!status.is_ok()) plan = {};
  const std::size_t lods = array_bytes<Lod>(coarser.count);
  for (std::size_t i = 0; i < plan.stage_count; ++i) plan.stages[i].bytes += lods - before;
  if (plan.stage_count > 0) plan.bytes += lods - before;
  return status;
}

std::size_t worst_bytes(std::size_t vertex_count, std::size_t refined_count, std::size_t sample_count,
                        const Options& options) {
  constexpr std::size_t most_chart_faces = AtlasOptions().most_faces_per_chart;
  // One chart needs a sparse factor of its whole map; the strip its matching.
  const std::size_t single = options.atlas == AtlasKind::single ? 1400 * refined_count : 0;
  const std::size_t strip = options.fluency == Fluency::strip ? 100 * refined_count : 0;
  // Arrays over the surface, all its edges lines at worst; the chart that takes most; arrays over the samples.
  const std::size_t chart = refined_count < most_chart_faces ? refined_count : most_chart_faces;
  return (std::size_t{1} << 20) + 120 * vertex_count + 200 * refined_count + 300 * chart + 900 * sample_count + single +
         strip;
}

std::size_t enough_bytes(const State* state, Span<const Lod> coarser, std::size_t worst) {
  if (state == nullptr) return worst;
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  const State& s = *state;
  const std::size_t before = s.mark.front + s.mark.back;
  if (s.sizes.surface_bytes > 0) {
    MemoryPlan plan;
    add_stages(s, s.sizes, coarser, plan);
    if (plan.bytes > s.arena->capacity() + misfit) return plan.bytes;
  } else if (s.stage >= atlas_stage) {
    const std::size_t first = larger_count(s, s.plan.first_count), last = s.options.vertex_count;
    std::size_t named =
        before + worst_bytes(s.view.vertex_count, s.surface.mesh.face_count(), first > last ? first : last, s.options);
    for (const Lod& lod : coarser) named += std::size_t{500} * lod.vertex_count;
    if (named > s.arena->capacity() && named < worst) return named;
  }
  return worst;
}

Status plan(const MeshView& view, const Options& options, MemoryPlan& plan, Arena& arena) {
  const std::size_t before = arena.used();
  Status status = plan_memory(view, options, {}, plan, arena);
  if (status == Status::out_of_memory) {
    status.value = before + required_memory(view.vertex_count, view.triangle_count, options);
  }
  return status;
}

}  // namespace v1
}  // namespace isolod
