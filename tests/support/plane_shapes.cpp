#include "support/plane_shapes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/make_atlas.h"
#include "sample/diffuse.h"
#include "support/exact.h"
#include "surface/features.h"

namespace support {

using namespace isolod;
using isolod_test::exact_in_circle;
using isolod_test::exact_orientation;

// ---- soups

Soup grid_where(std::uint32_t n, const std::function<bool(std::uint32_t, std::uint32_t)>& has_quad) {
  Soup soup;
  std::vector<std::uint32_t> number((n + 1) * (n + 1), UINT32_MAX);
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    std::uint32_t& v = number[j * (n + 1) + i];
    if (v == UINT32_MAX) v = soup.vertex(double(i) / n, double(j) / n, 0);
    return v;
  };
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      if (!has_quad(i, j)) continue;
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if ((i + j) % 2 == 0) {
        soup.face(a, b, c), soup.face(a, c, d);
      } else {
        soup.face(a, b, d), soup.face(b, c, d);
      }
    }
  }
  return soup;
}

Soup square_grid(std::uint32_t n, double side) {
  return grid_where(n, [](std::uint32_t, std::uint32_t) { return true; }).scaled(side);
}

Soup holed_grid() {
  return grid_where(7, [](std::uint32_t i, std::uint32_t j) { return i % 4 != 2 || j % 4 != 2; });
}

Soup tetrahedron() {
  Soup soup;
  for (std::uint32_t i = 0; i < 4; ++i) soup.vertex(i == 1, i == 2, i == 3);
  soup.face(0, 2, 1), soup.face(0, 1, 3), soup.face(1, 2, 3), soup.face(2, 0, 3);
  return soup;
}

Soup bent(Soup soup, const std::function<Vec3(Vec3)>& way) {
  for (Vec3& p : soup.positions) p = way(p);
  return soup;
}

Edges edges_where(const Soup& soup, const std::function<bool(Vec3, Vec3)>& belong) {
  Edges edges;
  for (const Soup::Triangle& t : soup.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (belong(soup.positions[a], soup.positions[b])) edges.push_back({a, b});
    }
  }
  return edges;
}

Soup made_soup(const std::string& name, std::size_t triangles) {
  shapes::Shape shape;
  REQUIRE(shapes::make(name, triangles, shape));
  Soup soup;
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) {
    soup.vertex(shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]);
  }
  for (std::size_t i = 0; i < shape.triangles.size(); i += 3) {
    soup.face(shape.triangles[i], shape.triangles[i + 1], shape.triangles[i + 2]);
  }
  return soup;
}

Soup rotated(const Soup& soup) {
  // A quaternion of whole numbers, 1 + 2 i + 3 j + 5 k, of squared length 39.
  return bent(soup, [](Vec3 p) {
    return (1.0 / 39) *
           Vec3{-29 * p.x + 2 * p.y + 26 * p.z, 22 * p.x - 19 * p.y + 26 * p.z, 14 * p.x + 34 * p.y + 13 * p.z};
  });
}

Piece::Piece(Soup given, double feature_angle, const Edges& tagged)
    : soup(std::move(given)), block(std::size_t{1 << 20} + 4000 * soup.triangles.size()), view(soup.view()) {
  for (const auto& edge : tagged) tagged_.insert(tagged_.end(), {edge.first, edge.second});
  view.tagged_edges = tagged_.data();
  view.tagged_edge_count = tagged.size();
  identity_.resize(std::max(soup.positions.size(), soup.triangles.size()));
  for (std::uint32_t i = 0; i < identity_.size(); ++i) identity_[i] = i;
  surface.view = &view;
  surface.source_vertex = {identity_.data(), soup.positions.size()};
  surface.source_face = {identity_.data(), soup.triangles.size()};
  REQUIRE(block.arena.result(3 * soup.triangles.size(), surface.mesh.origin).is_ok());
  for (std::size_t i = 0; i < surface.mesh.origin.count; ++i) {
    surface.mesh.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
  }
  REQUIRE(connect(surface.mesh, soup.positions.size(), block.arena).is_ok());
  REQUIRE(find_features(surface, {feature_angle, 30}, block.arena).is_ok());
}

void Piece::set_density(const std::function<double(Vec3)>& density) {
  REQUIRE(block.arena.result(surface.mesh.halfedge_count(), surface.wedge_density).is_ok());
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    surface.wedge_density[h] = static_cast<float>(density(surface.position(surface.mesh.origin[h])));
  }
}

Labels::Labels(std::vector<std::uint32_t> label_of_face) : label(std::move(label_of_face)) {
  const std::uint32_t count = *std::max_element(label.begin(), label.end()) + 1;
  place.resize(label.size());
  for (std::uint32_t l = 0; l < count; ++l) {
    start.push_back(static_cast<std::uint32_t>(faces.size()));
    for (std::uint32_t f = 0; f < label.size(); ++f) {
      if (label[f] != l) continue;
      place[f] = static_cast<std::uint32_t>(faces.size()) - start.back();
      faces.push_back(FaceId{f});
    }
  }
  start.push_back(static_cast<std::uint32_t>(faces.size()));
}

Atlas Labels::atlas() {
  return {{label.data(), label.size()},
          {faces.data(), faces.size()},
          {start.data(), start.size()},
          {place.data(), place.size()}};
}

std::vector<Vec2> map_by_halfedge(const Surface& surface, Atlas& atlas, const ChartMaps& maps, Arena& arena) {
  if (atlas.place.empty()) REQUIRE(index_places(atlas, arena).is_ok());
  std::vector<Vec2> out(surface.mesh.halfedge_count());
  for (std::size_t c = 0; c < atlas.chart_count(); ++c) {
    const ScratchScope scope(arena);
    FlatChart flat;
    REQUIRE(build_flat_chart(surface, atlas, maps, c, flat, arena).is_ok());
    const Halfedges& mesh = flat.chart.mesh;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      out[flat.chart.on_surface(h).value] = flat.uv[mesh.origin[h]];
    }
  }
  return out;
}

SampledPiece::SampledPiece(Piece& p, std::uint32_t vertex_count) : piece(p) {
  const Surface& surface = piece.surface;
  const std::size_t faces = surface.mesh.face_count();
  Arena& arena = piece.block.arena;
  rates = solve_rates(integrate_density(surface), vertex_count, Calibration::corrected);
  REQUIRE(arena.result(faces, atlas.chart_of_face).is_ok());
  REQUIRE(arena.result(faces, atlas.faces).is_ok());
  REQUIRE(arena.result(faces, atlas.place).is_ok());
  REQUIRE(arena.result(2, atlas.start).is_ok());
  REQUIRE(arena.result(3 * faces, uv.rounded).is_ok());
  for (FaceId f : Ids<FaceId>(faces)) atlas.chart_of_face[f] = 0, atlas.faces[f] = f, atlas.place[f] = f.value;
  atlas.start[0] = 0, atlas.start[1] = static_cast<std::uint32_t>(faces);
  for (HalfedgeId h : Ids<HalfedgeId>(3 * faces)) {
    const Vec3 at = surface.position(surface.mesh.origin[h]);
    uv.rounded[h] = {static_cast<float>(at.x), static_cast<float>(at.y)};
  }
  sample(vertex_count);
}

SampledPiece::SampledPiece(Piece& p, std::uint32_t vertex_count, double samples_per_chart) : piece(p) {
  rates = solve_rates(integrate_density(piece.surface), vertex_count, Calibration::corrected);
  AtlasOptions options;
  options.line_rate = rates.line;
  options.surface_rate = rates.surface;
  options.samples_per_chart = samples_per_chart;
  MakeAtlas stage;
  REQUIRE(stage.begin(piece.surface, options, piece.block.arena).is_ok());
  while (!stage.done()) REQUIRE(stage.step(piece.block.arena).is_ok());
  REQUIRE(stage.finish(piece.surface, atlas, uv, piece.block.arena).is_ok());
  REQUIRE(index_places(atlas, piece.block.arena).is_ok());
  sample(vertex_count);
}

void SampledPiece::sample(std::uint32_t vertex_count) {
  const Surface& surface = piece.surface;
  Arena& arena = piece.block.arena;
  REQUIRE(chain_backbones(surface, backbones, arena).is_ok());
  const std::uint32_t nodes = static_cast<std::uint32_t>(backbones.node.count);
  REQUIRE(vertex_count > nodes);
  REQUIRE(sample_lines(surface, backbones, rates.line, vertex_count - nodes, lines, arena).is_ok());
  numbers = {nodes, static_cast<std::uint32_t>(lines.place.count)};
  const std::uint32_t inside = vertex_count - first_movable();
  Span<std::uint32_t> face_count;
  REQUIRE(arena.result(inside, places).is_ok());
  REQUIRE(arena.result(atlas.chart_count() + 1, chart_start).is_ok());
  REQUIRE(arena.result(surface.mesh.face_count(), face_count).is_ok());
  FluencyReport report;
  REQUIRE(diffuse({&surface, &backbones, &lines, rates.surface, inside}, face_count, report, arena).is_ok());
  place_samples(surface, {atlas.faces, atlas.start}, face_count, chart_start, places);
}

// ---- points and plane triangulations

Points random_points(Random& random, std::size_t count) {
  Points points(count);
  for (Vec2& p : points) p.x = random.unit(), p.y = random.unit();
  return points;
}

Points lattice_points(Random& random, std::uint32_t n) {
  Points points;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    points.push_back({double(i % n) / (n - 1), double(i / n) / (n - 1)});
    std::swap(points.back(), points[random.below(points.size())]);
  }
  return points;
}

Points cocircular_points() {
  Points points;
  const double triples[][3] = {{3, 4, 5}, {5, 12, 13}, {8, 15, 17}, {7, 24, 25}, {0, 1, 1}};
  const double common = 5 * 13 * 17 * 5;  // whole numbers: exactly on two circles about (0, 0)
  for (const auto& t : triples) {
    for (const double radius : {common, 2 * common}) {
      const double a = t[0] * (radius / t[2]), b = t[1] * (radius / t[2]);
      for (const double sign : {-1.0, 1.0}) {
        points.push_back({sign * a, sign * b});
        points.push_back({sign * b, -sign * a});
        if (a != 0) points.push_back({sign * a, -sign * b}), points.push_back({sign * b, sign * a});
      }
    }
  }
  return points;
}

Points moved(Points points, double scale, bool turned) {
  for (Vec2& p : points) {
    if (turned) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
    p = scale * p;
  }
  return points;
}

namespace {

VertexId corner(const Halfedges& mesh, FaceId f, std::uint32_t k) { return mesh.origin[halfedge(f, k)]; }

int side(const PlaneTriangulation& p, VertexId a, VertexId b, VertexId c) {
  return exact_orientation(p.point[a], p.point[b], p.point[c]);
}

}  // namespace

PlaneMesh::PlaneMesh(const Points& points) : block(std::size_t{1 << 16} + 800 * points.size()) {
  const std::size_t vertices = points.size() + 64, faces = 2 * vertices;
  REQUIRE(reserve(plane.t, vertices, faces, block.arena).is_ok());
  REQUIRE(block.arena.scratch(vertices, plane.point).is_ok());
  REQUIRE(block.arena.scratch(3 * faces, stack.edge).is_ok());
  Vec2 low = points.empty() ? Vec2{0, 0} : points[0], high = points.empty() ? Vec2{1, 1} : points[0];
  for (const Vec2 p : points) {
    low = {smaller(low.x, p.x), smaller(low.y, p.y)};
    high = {greater(high.x, p.x), greater(high.y, p.y)};
  }
  const double rim = 0.0625 * (high.x - low.x + high.y - low.y);
  const Vec2 corners[4] = {{low.x - rim, low.y - rim},
                           {high.x + rim, low.y - rim},
                           {high.x + rim, high.y + rim},
                           {low.x - rim, high.y + rim}};
  Halfedges& mesh = plane.t.mesh;
  mesh.origin.count = mesh.twin.count = plane.t.fixed.count = 6;
  mesh.outgoing.count = 4;
  const std::uint32_t triangles[6] = {0, 1, 2, 0, 2, 3};
  for (std::uint32_t i = 0; i < 6; ++i) {
    mesh.origin[i] = VertexId{triangles[i]};
    mesh.twin[i] = i == 2 ? HalfedgeId{3} : i == 3 ? HalfedgeId{2} : none<HalfedgeId>();
    plane.t.fixed[i] = i != 2 && i != 3;
  }
  for (std::uint32_t i = 0; i < 4; ++i) plane.point[i] = corners[i];
  link_vertices(mesh);
  for (const Vec2 p : points) insert(p);
}

void PlaneMesh::insert(Vec2 p) {
  const Halfedges& mesh = plane.t.mesh;
  const VertexId v{static_cast<std::uint32_t>(mesh.vertex_count())};
  plane.point[v] = p;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (plane.t.is_dead(f)) continue;
    int sides[3];
    for (std::uint32_t k = 0; k < 3; ++k) sides[k] = side(plane, corner(mesh, f, k), corner(mesh, f, (k + 1) % 3), v);
    if (sides[0] < 0 || sides[1] < 0 || sides[2] < 0) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (sides[k] == 0) return split_edge(plane.t, halfedge(f, k), v);
    }
    return split_face(plane.t, f, v);
  }
  FAIL("a point outside of the triangulation");
}

void PlaneMesh::shake(Random& random, std::uint32_t tries) {
  const Halfedges& mesh = plane.t.mesh;
  for (std::uint32_t i = 0; i < tries; ++i) {
    const HalfedgeId h{random.below(mesh.halfedge_count())};
    if (plane.t.is_dead(face(h)) || !can_flip(plane.t, h)) continue;
    const VertexId c = mesh.apex(h), d = mesh.apex(mesh.twin[h]);
    if (side(plane, d, mesh.target(h), c) > 0 && side(plane, c, mesh.origin[h], d) > 0) flip(plane.t, h);
  }
}

bool PlaneMesh::crosses(VertexId a, VertexId b, HalfedgeId h) const {
  const VertexId c = plane.t.mesh.origin[h], d = plane.t.mesh.target(h);
  return side(plane, a, b, c) * side(plane, a, b, d) < 0 && side(plane, c, d, a) * side(plane, c, d, b) < 0;
}

bool PlaneMesh::constrain(VertexId a, VertexId b) {
  const Halfedges& mesh = plane.t.mesh;
  for (int round = 0; round < 200; ++round) {
    HalfedgeId found = find_halfedge(mesh, a, b);
    if (found.is_none()) found = find_halfedge(mesh, b, a);
    if (!found.is_none()) {
      plane.t.fixed[found] = 1;
      if (!mesh.is_boundary(found)) plane.t.fixed[mesh.twin[found]] = 1;
      return true;
    }
    bool moved_on = false;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      if (plane.t.is_dead(face(h)) || mesh.is_boundary(h) || !crosses(a, b, h)) continue;
      if (!can_flip(plane.t, h)) {
        if (plane.t.is_fixed(h)) return false;
        continue;
      }
      const VertexId c = mesh.apex(h), d = mesh.apex(mesh.twin[h]);
      if (!(side(plane, d, mesh.target(h), c) > 0 && side(plane, c, mesh.origin[h], d) > 0)) continue;
      flip(plane.t, h);
      moved_on = true;
    }
    if (!moved_on) return false;
  }
  return false;
}

// ---- naive checks

namespace {

using Ends = std::pair<std::uint32_t, std::uint32_t>;

std::string at(const char* what, std::uint32_t index) { return std::string(what) + " " + std::to_string(index); }

std::string broken_halfedge(const Triangulation& t, HalfedgeId h) {
  const Halfedges& mesh = t.mesh;
  const HalfedgeId g = mesh.twin[h];
  if (mesh.origin[h].is_none() || mesh.origin[h].value >= mesh.vertex_count()) return at("origin of", h.value);
  if (mesh.origin[h] == mesh.target(h)) return at("loop at", h.value);
  if (g.is_none()) return "";
  if (g.value >= mesh.halfedge_count() || t.is_dead(face(g))) return at("twin is dead of", h.value);
  if (mesh.twin[g] != h) return at("twin of twin of", h.value);
  if (mesh.origin[g] != mesh.target(h) || mesh.target(g) != mesh.origin[h])
    return at("twin is not opposite of", h.value);
  return t.fixed[g] == t.fixed[h] ? "" : at("fixed on one side only at", h.value);
}

}  // namespace

std::string broken(const Triangulation& t) {
  const Halfedges& mesh = t.mesh;
  std::set<Ends> sides;
  std::map<std::uint32_t, std::size_t> leaving, border;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (t.is_dead(face(h))) continue;
    const std::string fault = broken_halfedge(t, h);
    if (!fault.empty()) return fault;
    if (!sides.insert({mesh.origin[h].value, mesh.target(h).value}).second) return at("doubled side", h.value);
    ++leaving[mesh.origin[h].value];
    border[mesh.origin[h].value] += mesh.is_boundary(h);
  }
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (t.is_dead(face(h)) || !mesh.is_boundary(h)) continue;
    if (sides.count({mesh.target(h).value, mesh.origin[h].value}) != 0) return at("doubled edge", h.value);
  }
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    const HalfedgeId first = mesh.outgoing[v];
    if (first.is_none() != (leaving[v.value] == 0)) return at("outgoing of unused or used vertex", v.value);
    if (first.is_none()) continue;
    if (first.value >= mesh.halfedge_count() || mesh.origin[first] != v) return at("outgoing of vertex", v.value);
    if (border[v.value] > 1) return at("several fans at vertex", v.value);
    if ((border[v.value] == 1) != mesh.is_boundary(first)) return at("boundary rule at vertex", v.value);
    std::size_t reached = 0;
    HalfedgeId h = first;
    do {
      ++reached;
      h = mesh.turn_left(h);
    } while (!h.is_none() && h != first && reached <= leaving[v.value]);
    if (reached != leaving[v.value]) return at("fan of vertex", v.value);
  }
  return "";
}

long live_faces(const Triangulation& t) {
  long count = 0;
  for (FaceId f : Ids<FaceId>(t.mesh.face_count())) count += !t.is_dead(f);
  return count;
}

long euler(const Triangulation& t) {
  std::set<std::uint32_t> vertices;
  std::set<Ends> edges;
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (t.is_dead(face(h))) continue;
    const std::uint32_t a = t.mesh.origin[h].value, b = t.mesh.target(h).value;
    vertices.insert(a);
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  return long(vertices.size()) - long(edges.size()) + live_faces(t);
}

long boundary_loops(const Halfedges& mesh) {
  std::map<std::uint32_t, std::uint32_t> following;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!mesh.origin[h].is_none() && mesh.is_boundary(h)) following[mesh.origin[h].value] = mesh.target(h).value;
  }
  long loops = 0;
  while (!following.empty()) {
    ++loops;
    for (auto it = following.begin(); it != following.end();) {
      const std::uint32_t to = it->second;
      following.erase(it);
      it = following.find(to);
    }
  }
  return loops;
}

bool is_connected(const Halfedges& mesh, const std::vector<FaceId>& faces) {
  std::set<std::uint32_t> left;
  for (FaceId f : faces) left.insert(f.value);
  std::vector<std::uint32_t> open{*left.begin()};
  left.erase(left.begin());
  while (!open.empty()) {
    const FaceId f{open.back()};
    open.pop_back();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId t = mesh.twin[halfedge(f, k)];
      if (!t.is_none() && left.erase(face(t).value) != 0) open.push_back(face(t).value);
    }
  }
  return left.empty();
}

std::uint32_t not_delaunay_edges(const PlaneTriangulation& p) {
  const Halfedges& mesh = p.t.mesh;
  std::uint32_t count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (p.t.is_dead(face(h)) || mesh.is_boundary(h) || p.t.is_fixed(h)) continue;
    count += exact_in_circle(p.point[mesh.origin[h]], p.point[mesh.target(h)], p.point[mesh.apex(h)],
                             p.point[mesh.apex(mesh.twin[h])]) > 0;
  }
  return count;
}

std::uint32_t vertices_inside_circles(const PlaneTriangulation& p) {
  const Halfedges& mesh = p.t.mesh;
  std::uint32_t count = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (p.t.is_dead(f)) continue;
    const VertexId a = corner(mesh, f, 0), b = corner(mesh, f, 1), c = corner(mesh, f, 2);
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
      if (mesh.outgoing[v].is_none() || v == a || v == b || v == c) continue;
      count += exact_in_circle(p.point[a], p.point[b], p.point[c], p.point[v]) > 0;
    }
  }
  return count;
}

std::uint32_t inverted_faces(const PlaneTriangulation& p) {
  std::uint32_t count = 0;
  for (FaceId f : Ids<FaceId>(p.t.mesh.face_count())) {
    if (p.t.is_dead(f)) continue;
    count += side(p, corner(p.t.mesh, f, 0), corner(p.t.mesh, f, 1), corner(p.t.mesh, f, 2)) <= 0;
  }
  return count;
}

}  // namespace support
