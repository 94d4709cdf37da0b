#include "plane/whole_system.h"

#include "base/status.h"
#include "plane/dissection.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_gradient_steps = 12;  // of conjugate gradient in a round
constexpr double least_apex_height = 1e-12;        // of a triangle, over its longest side: less is lost in rounding
constexpr double reduction = 1e-10;                // of the error's energy in a round, squared

}  // namespace

Vec2 WholeSystem::side(HalfedgeId corner) const {
  const FaceId f = face(corner);
  switch (corner.value % 3) {
    case 1:
      return side_one_[f];
    case 2:
      return side_two_[f];
    default:
      return -1.0 * (side_one_[f] + side_two_[f]);
  }
}

void WholeSystem::lay_down(Span<const Vec3> position) {
  for (FaceId f : Ids<FaceId>(mesh_->face_count())) {
    Vec3 p[3];
    for (std::uint32_t k = 0; k < 3; ++k) p[k] = position[mesh_->origin[halfedge(f, k)]];
    std::uint32_t base = 0;  // the longest side lies along the first axis: its height is the most precise
    for (std::uint32_t k = 1; k < 3; ++k) {
      if (distance(p[k], p[(k + 1) % 3]) > distance(p[base], p[(base + 1) % 3])) base = k;
    }
    const Vec3 along = p[(base + 1) % 3] - p[base], other = p[(base + 2) % 3] - p[base];
    const double width = length(along);
    if (!(width > 0)) {
      side_one_[f] = side_two_[f] = {0, 0};
      continue;
    }
    const Vec2 apex{dot(other, along) / width, greater(length(cross(along, other)) / width, least_apex_height * width)};
    const double scale = 1 / square_root(width * apex.y);
    Vec2 e[3];
    e[base] = scale * Vec2{apex.x - width, apex.y};
    e[(base + 1) % 3] = scale * Vec2{-apex.x, -apex.y};
    e[(base + 2) % 3] = scale * Vec2{width, 0};
    side_one_[f] = e[1];
    side_two_[f] = e[2];
  }
}

void WholeSystem::assemble() {
  const std::size_t n = mesh_->vertex_count();
  const auto is_pinned = [&](VertexId v) { return v == pins_.first || v == pins_.second; };
  std::uint32_t filled = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    const VertexId v = order_[k];
    matrix_.start[k] = filled;
    double diagonal = 0;
    const auto add = [&](HalfedgeId own, HalfedgeId other) {  // corners of v and of its neighbour in one face
      const VertexId w = mesh_->origin[other];
      if (is_pinned(v) || is_pinned(w) || place_[w] >= k) return;
      matrix_.row[filled] = place_[w];
      matrix_.value[filled++] = conjugate_times(side(other), side(own));
    };
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) {
      diagonal += dot(side(h), side(h));
      add(h, next(h));
      add(h, prev(h));
    });
    matrix_.diagonal[k] = is_pinned(v) ? 1 : diagonal;
  }
  matrix_.start[n] = filled;
}

Status WholeSystem::begin(const Halfedges& mesh, Span<const Vec3> position, Pins pins, Arena& arena) {
  mesh_ = &mesh;
  pins_ = pins;
  iterations_ = 0;
  const std::size_t n = mesh.vertex_count();
  ISOLOD_TRY(arena.scratch(mesh.face_count(), side_one_));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), side_two_));
  ISOLOD_TRY(arena.scratch(n, order_));
  ISOLOD_TRY(arena.scratch(n, place_));
  ISOLOD_TRY(arena.scratch(n, residual_));
  ISOLOD_TRY(arena.scratch(n, direction_));
  ISOLOD_TRY(arena.scratch(n, image_));
  ISOLOD_TRY(arena.scratch(n, change_));
  ISOLOD_TRY(arena.scratch(n, permuted_));
  lay_down(position);
  ISOLOD_TRY(dissect(mesh, position, order_, arena));
  for (std::uint32_t k = 0; k < n; ++k) place_[order_[k]] = k;
  const std::size_t entries = mesh.halfedge_count();  // three pairs of corners a face
  ISOLOD_TRY(arena.scratch(n + 1, matrix_.start));
  ISOLOD_TRY(arena.scratch(entries, matrix_.row));
  ISOLOD_TRY(arena.scratch(entries, matrix_.value));
  ISOLOD_TRY(arena.scratch(n, matrix_.diagonal));
  assemble();
  return {};
}

Vec2 WholeSystem::mirrored_part(FaceId f, Span<const Vec2> z) const {
  const Vec2 z0 = z[mesh_->origin[halfedge(f, 0)]];
  const Vec2 z1 = z[mesh_->origin[halfedge(f, 1)]], z2 = z[mesh_->origin[halfedge(f, 2)]];
  return times(side_one_[f], z1 - z0) + times(side_two_[f], z2 - z0);
}

void WholeSystem::gradient(Span<const Vec2> z, Span<Vec2> out) const {
  for (Vec2& g : out) g = {0, 0};
  for (FaceId f : Ids<FaceId>(mesh_->face_count())) {
    const Vec2 part = mirrored_part(f, z);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId corner = halfedge(f, k);
      Vec2& g = out[mesh_->origin[corner]];
      g = g + conjugate_times(side(corner), part);
    }
  }
  out[pins_.first] = out[pins_.second] = {0, 0};
}

double WholeSystem::relative_residual(Span<const Vec2> z) const {
  double worst = 0;
  for (VertexId v : Ids<VertexId>(z.count)) {
    if (v == pins_.first || v == pins_.second) continue;
    Vec2 sum{0, 0};
    double size = 0;
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) {
      sum = sum + conjugate_times(side(h), mirrored_part(face(h), z));
      const Vec2 one = conjugate_times(side(h), times(side(next(h)), z[mesh_->target(h)] - z[v]));
      const Vec2 two = conjugate_times(side(h), times(side(prev(h)), z[mesh_->apex(h)] - z[v]));
      size += length(one) + length(two);
    });
    if (size > 0) worst = greater(worst, length(sum) / size);
  }
  return worst;
}

void WholeSystem::precondition(Span<const Vec2> r, Span<Vec2> out) {
  for (VertexId v : Ids<VertexId>(r.count)) permuted_[place_[v]] = r[v];
  factor_.solve(permuted_);
  for (VertexId v : Ids<VertexId>(r.count)) out[v] = permuted_[place_[v]];
  out[pins_.first] = out[pins_.second] = {0, 0};
}

double WholeSystem::refine(Span<Vec2> z, VertexId still) {
  const std::size_t n = z.count;
  gradient(z, residual_);
  for (std::size_t i = 0; i < n; ++i) {
    residual_[i] = -1.0 * residual_[i];
    change_[i] = {0, 0};
  }
  const Span<Vec2> solved = image_;  // the solution and the image of the direction are not needed at once
  precondition(residual_, solved);
  double energy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    direction_[i] = solved[i];
    energy += dot(residual_[i], solved[i]);
  }
  const double first = energy;
  for (std::uint32_t step = 0; step < most_gradient_steps && energy > reduction * first; ++step) {
    gradient(direction_, image_);
    double curvature = 0;
    for (std::size_t i = 0; i < n; ++i) curvature += dot(direction_[i], image_[i]);
    if (!(curvature > 0)) break;
    ++iterations_;
    const double stride = energy / curvature;
    for (std::size_t i = 0; i < n; ++i) {
      change_[i] = change_[i] + stride * direction_[i];
      residual_[i] = residual_[i] - stride * image_[i];
    }
    precondition(residual_, solved);
    double left = 0;
    for (std::size_t i = 0; i < n; ++i) left += dot(residual_[i], solved[i]);
    for (std::size_t i = 0; i < n; ++i) direction_[i] = solved[i] + (left / energy) * direction_[i];
    energy = left;
  }
  return correct(z, still);
}

double WholeSystem::correct(Span<Vec2> z, VertexId still) {
  const Vec2 drift = change_[still];
  for (std::size_t i = 0; i < z.count; ++i) {
    change_[i] = change_[i] - drift;
    z[i] = z[i] + change_[i];
  }
  double greatest = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh_->halfedge_count())) {
    const VertexId a = mesh_->origin[h], b = mesh_->target(h);
    const double moved = distance(change_[a], change_[b]), length_now = distance(z[a], z[b]);
    if (moved > 0) greatest = greater(greatest, length_now > 0 ? moved / length_now : 1e300);
  }
  return greatest;
}

}  // namespace v1
}  // namespace isolod
