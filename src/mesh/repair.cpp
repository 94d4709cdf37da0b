#include "mesh/repair.h"

#include "base/sort.h"
#include "base/status.h"
#include "mesh/collinear.h"
#include "mesh/vertex_sets.h"
#include "mesh/view.h"

namespace isolod {
inline namespace v1 {

bool RepairReport::changed() const {
  return welded_vertices != 0 || unused_vertices != 0 || degenerate_triangles != 0 || duplicate_triangles != 0 ||
         nonmanifold_edges_cut != 0 || nonmanifold_vertices_cut != 0 || flipped_triangles != 0 || one_sided_cuts != 0;
}

Status Repair::begin(const MeshView& view, bool weld, Arena& arena) {
  constexpr std::uint64_t most = std::uint64_t{1} << 31;
  *this = Repair();
  if (view.vertex_count >= most) return fail(Status::too_large, Element::vertex, view.vertex_count);
  if (view.triangle_count >= most / 3) return fail(Status::too_large, Element::triangle, view.triangle_count);
  if (view.triangle_count == 0) return fail(Status::empty_mesh);
  if (view.indices == nullptr || view.positions == nullptr) return fail(Status::index_out_of_range, Element::triangle);
  view_ = view;
  weld_ = weld;
  arena_ = &arena;
  start_ = arena.mark();
  phase_ = Phase::check_positions;
  return {};
}

Status Repair::step() {
  if (done()) return {};
  const Status status = run_phase();
  if (status.is_ok()) {
    if (sweep_.is_at_start()) phase_ = static_cast<Phase>(static_cast<int>(phase_) + 1);
  } else {
    arena_->rewind_scratch(start_);
    phase_ = Phase::done;
  }
  return status;
}

Status Repair::run_phase() {
  switch (phase_) {
    case Phase::check_positions:
      return check_positions();
    case Phase::read_triangles:
      return read_triangles();
    case Phase::weld:
      return weld_positions();
    case Phase::collapse:
      return collapse_sides();
    case Phase::find_flat:
      return find_flat_triangles();
    case Phase::remove_flat:
      return remove_flat_triangles();
    case Phase::link:
      return link_edges();
    case Phase::close_rings:
      return close_rings();
    case Phase::orient:
      return orient_triangles();
    case Phase::pair:
      return pair_edges();
    case Phase::copy_vertices:
      return copy_vertices();
    case Phase::done:
      break;
  }
  return {};
}

Status Repair::check_positions() {
  for (std::size_t v = 0; v < view_.vertex_count; ++v) {
    const Vec3 p = read_position(view_, v);
    const bool finite = p.x - p.x == 0 && p.y - p.y == 0 && p.z - p.z == 0;
    if (!finite) return fail(Status::position_not_finite, Element::vertex, v);
  }
  return {};
}

Status Repair::read_triangles() {
  ISOLOD_TRY(arena_->scratch(3 * view_.triangle_count, corners_));
  ISOLOD_TRY(arena_->scratch(view_.triangle_count, flags_));
  for (std::size_t c = 0; c < corners_.count; ++c) {
    const std::uint32_t vertex = read_index(view_, c);
    if (vertex >= view_.vertex_count) return fail(Status::index_out_of_range, Element::triangle, c / 3);
    corners_[c] = VertexId{vertex};
  }
  for (std::uint8_t& f : flags_) f = 0;
  before_links_ = arena_->mark();
  return {};
}

Status Repair::weld_positions() {
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, merged_));
  make_singletons(merged_);
  if (!weld_) return {};
  const ScratchScope scope(*arena_);
  Span<VertexId> order, buffer;
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, order));
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, buffer));
  make_singletons(order);
  merge_sort(order, buffer, [this](VertexId a, VertexId b) {
    return lies_before(read_position(view_, a.value), read_position(view_, b.value));
  });
  VertexId first = order[0];
  for (VertexId v : order) {
    if (!same_position(read_position(view_, first.value), read_position(view_, v.value))) first = v;
    merged_[v] = first;
  }
  return {};
}

Status Repair::collapse_sides() {
  for (FaceId f : Ids<FaceId>(face_count())) {
    const VertexId* const corner = &corners_[3 * std::size_t{f.value}];
    const Vec3 p[3] = {read_position(view_, corner[0].value), read_position(view_, corner[1].value),
                       read_position(view_, corner[2].value)};
    for (int k = 0; k < 3; ++k) {
      if (same_position(p[k], p[(k + 1) % 3])) unite(merged_, corner[k], corner[(k + 1) % 3]);
    }
  }
  for (VertexId v : Ids<VertexId>(merged_.count)) report_.welded_vertices += set_of(merged_, v) != v;
  for (VertexId& v : corners_) v = set_of(merged_, v);
  arena_->rewind_scratch(before_links_);
  merged_ = {};
  return {};
}

Status Repair::find_flat_triangles() {
  std::size_t flat_count = 0;
  for (FaceId f : Ids<FaceId>(face_count())) {
    const VertexId* const corner = &corners_[3 * std::size_t{f.value}];
    const VertexId a = corner[0], b = corner[1], c = corner[2];
    if (a == b || b == c || c == a) {
      flags_[f] = dead;
    } else if (exactly_collinear(read_position(view_, a.value), read_position(view_, b.value),
                                 read_position(view_, c.value))) {
      flags_[f] = flat;
      ++flat_count;
    }
    report_.degenerate_triangles += flags_[f] != 0;
  }
  if (flat_count == 0) return {};
  ISOLOD_TRY(arena_->scratch(flat_count, flats_));
  std::size_t i = 0;
  for (FaceId f : Ids<FaceId>(face_count())) {
    if (is_flat(f)) flats_[i++] = {f, f.value};
  }
  before_links_ = arena_->mark();
  return {};
}

std::size_t Repair::flat_index(FaceId f) const {
  std::size_t low = 0, high = flats_.count;
  while (low + 1 < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (f < flats_[middle].face) {
      high = middle;
    } else {
      low = middle;
    }
  }
  return low;
}

std::uint32_t Repair::source_of(FaceId f) const { return has(f, moved) ? flats_[flat_index(f)].source : f.value; }

Status Repair::number_vertices(Span<std::uint32_t>& source_vertex, Arena& arena) {
  Span<VertexId> number;
  ISOLOD_TRY(arena.scratch(view_.vertex_count + copied_from_.count, number));
  for (VertexId& n : number) n = none<VertexId>();
  for (FaceId f : Ids<FaceId>(face_count())) {
    for (std::size_t k = 0; k < 3 && !is_dead(f); ++k) number[corners_[3 * std::size_t{f.value} + k]] = VertexId{0};
  }
  std::uint32_t count = 0;
  for (VertexId v : Ids<VertexId>(number.count)) {
    if (!number[v].is_none()) number[v] = VertexId{count++};
    if (v.value + std::size_t{1} == view_.vertex_count) {
      report_.unused_vertices = static_cast<std::uint32_t>(view_.vertex_count) - report_.welded_vertices - count;
    }
  }
  ISOLOD_TRY(arena.result(count, source_vertex));
  for (VertexId v : Ids<VertexId>(number.count)) {
    if (number[v].is_none()) continue;
    source_vertex[number[v]] =
        v.value < view_.vertex_count ? v.value : copied_from_[v.value - view_.vertex_count].value;
  }
  for (FaceId f : Ids<FaceId>(face_count())) {
    for (std::size_t k = 0; k < 3 && !is_dead(f); ++k) {
      VertexId& corner = corners_[3 * std::size_t{f.value} + k];
      corner = number[corner];
    }
  }
  return {};
}

Status Repair::write_triangles(RepairedMesh& out, Arena& arena) {
  std::size_t count = 0;
  for (FaceId f : Ids<FaceId>(face_count())) count += !is_dead(f);
  if (count == 0) return fail(Status::empty_mesh);
  ISOLOD_TRY(arena.result(3 * count, out.triangles));
  ISOLOD_TRY(arena.result(count, out.source_triangle));
  std::size_t i = 0;
  for (FaceId f : Ids<FaceId>(face_count())) {
    if (is_dead(f)) continue;
    for (std::size_t k = 0; k < 3; ++k) out.triangles[3 * i + k] = corners_[3 * std::size_t{f.value} + k];
    out.source_triangle[i++] = source_of(f);
  }
  return {};
}

Status Repair::finish(RepairedMesh& out, RepairReport& report, Arena& arena) {
  ISOLOD_ASSERT(done() && &arena == arena_);
  const ArenaMark results = arena.mark();
  RepairedMesh mesh;
  Status status = number_vertices(mesh.source_vertex, arena);
  mesh.behind_vertices = arena.mark();
  arena.rewind_scratch(before_links_);
  if (status.is_ok()) status = write_triangles(mesh, arena);
  arena.rewind_scratch(start_);
  if (!status.is_ok()) {
    arena.rewind_results(results);
    return status;
  }
  out = mesh;
  report = report_;
  return {};
}

Status repair(const MeshView& view, bool weld, RepairedMesh& out, RepairReport& report, Arena& arena) {
  Repair stage;
  ISOLOD_TRY(stage.begin(view, weld, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step());
  return stage.finish(out, report, arena);
}

}  // namespace v1
}  // namespace isolod
