#include "surface/refine.h"

#include <cmath>
#include <map>

#include "mesh/validate.h"
#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Sums {
  double area = 0, density = 0;
  std::map<int, double> line_length;  // by kind
  std::int64_t euler = 0;
};

Sums sums_of(const Surface& s) {
  Sums sums;
  for (FaceId f : Ids<FaceId>(s.mesh.face_count())) {
    sums.area += face_area(s, f);
    sums.density += face_density(s, f);
  }
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    if (s.line[h] != line_none) sums.line_length[s.line[h]] += edge_length(s, h);
  }
  sums.euler = integrate_density(s).euler_characteristic;
  return sums;
}

void refine_all(Prepared& prepared, double line_rate, double limit = 1.25) {
  Refine refine;
  REQUIRE(refine.begin(prepared.surface, line_rate, limit, prepared.block.arena).is_ok());
  while (!refine.done()) REQUIRE(refine.step(prepared.surface, prepared.block.arena).is_ok());
}

/// The longest edge in wished edge lengths.
double longest(const Surface& s, double line_rate) {
  double most = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const double d = greater(s.density(h), s.density(next(h)));
    most = greater(most, edge_length(s, h) * line_rate * square_root(d));
  }
  return most;
}

/// Faces that do not lie in the plane of the caller's triangle that they name, or look the other way.
std::size_t faces_off_their_source(const Prepared& p) {
  const Surface& s = p.surface;
  const auto corner = [&](std::uint32_t triangle, std::uint32_t k) {
    return read_position(p.view, read_index(p.view, 3 * triangle + k));
  };
  std::size_t off = 0;
  for (FaceId f : Ids<FaceId>(s.mesh.face_count())) {
    const std::uint32_t t = s.source_face[f];
    if (t >= p.view.triangle_count) return s.mesh.face_count();
    const Vec3 a = corner(t, 0), normal = cross(corner(t, 1) - a, corner(t, 2) - a);
    bool fits = dot(normal, area_vector(s, f)) > 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      fits =
          fits && absolute(dot(normal, s.position(s.mesh.origin[halfedge(f, k)]) - a)) < 1e-6 * length(normal) * 200.0;
    }
    off += !fits;
  }
  return off;
}

void check_refined(Prepared& p, double line_rate) {
  const Sums before = sums_of(p.surface);
  const std::size_t corners = integrate_density(p.surface).corner_count, faces = p.surface.mesh.face_count();
  refine_all(p, line_rate);
  const Sums after = sums_of(p.surface);
  CHECK(p.surface.mesh.face_count() > faces);
  Finding finding;
  find_halfedge_defect(p.surface.mesh, finding);
  CHECK(finding.defect == Defect::none);
  REQUIRE(find_defect(p.surface.mesh.origin, {}, p.surface.mesh.vertex_count(), finding, p.block.arena).is_ok());
  CHECK(finding.defect == Defect::none);
  CHECK(longest(p.surface, line_rate) <= 1.25);
  CHECK(after.area == doctest::Approx(before.area).epsilon(1e-12));
  CHECK(after.density == doctest::Approx(before.density).epsilon(2e-3));  // flips in planes interpolate anew
  CHECK(after.euler == before.euler);
  CHECK(integrate_density(p.surface).corner_count == corners);
  CHECK(after.line_length.size() == before.line_length.size());
  for (const auto& [kind, length] : before.line_length)
    CHECK(after.line_length.at(kind) == doctest::Approx(length).epsilon(1e-12));
  CHECK(faces_off_their_source(p) == 0);
}

}  // namespace

TEST_CASE("refine: conforming, with area, lines, sources and corners kept, and no edge over the limit") {
  for (const std::string name : {"cube", "tetrahedron", "plate2", "bracket", "tube200", "cylinder_open"}) {
    CAPTURE(name);
    Prepared p(name, 0);
    p.features(30);
    check_refined(p, name == "tube200" ? 2 : 7.3);
  }
}

TEST_CASE("refine: the same with a density that varies by wedge") {
  Prepared p("bracket", 500);
  p.features(30).density(DensitySource::curvature, 1, 1);
  check_refined(p, 6);
}

TEST_CASE("refine: faces keep their orientation") {
  Prepared p("cube", 12);
  p.features();
  std::map<std::uint32_t, Vec3> normal;
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count()))
    normal[p.surface.source_face[f]] = area_vector(p.surface, f);
  refine_all(p, 10);
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    CHECK(dot(normal[p.surface.source_face[f]], area_vector(p.surface, f)) > 0);
  }
}

TEST_CASE("refine: a midpoint has the mean density of its edge's ends, wedge by wedge") {
  Prepared p("cube", 12);
  p.features(30).density(DensitySource::curvature, 1);
  Surface& s = p.surface;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {  // linear in space, another factor a side
    const Vec3 at = s.position(s.mesh.origin[h]);
    s.wedge_density[h] = static_cast<float>((4 + at.x + 0.5 * at.y) * (1 + s.source_face[face(h)] / 2));
  }
  refine_all(p, 3);
  std::size_t wrong = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const Vec3 at = s.position(s.mesh.origin[h]);
    const double wanted = (4 + at.x + 0.5 * at.y) * (1 + s.source_face[face(h)] / 2);
    wrong += absolute(s.density(h) - wanted) > 1e-5 * wanted;
  }
  CHECK(wrong == 0);
}

TEST_CASE("refine: the halves of a line have the density that it was given, and no other edge gets any") {
  Prepared p("bracket", 500);
  p.features(30);
  Surface& s = p.surface;
  std::vector<float> given(s.mesh.halfedge_count(), 0);
  std::map<float, double> before, after;  // length by density
  for (HalfedgeId h : Ids<HalfedgeId>(given.size())) {
    const HalfedgeId t = s.mesh.twin[h];
    const std::uint32_t lower = t.is_none() || h < t ? h.value : t.value;
    if (s.line[h] != line_none) given[h.value] = static_cast<float>(lower % 5);
    before[given[h.value]] += s.line[h] != line_none ? edge_length(s, h) : 0;
  }
  s.given_line_density = {given.data(), given.size()};
  REQUIRE(before.size() == 5);
  refine_all(p, 6);  // flips in planes, and splits
  REQUIRE(s.given_line_density.count == s.mesh.halfedge_count());
  CHECK(s.mesh.halfedge_count() > given.size());
  int wrong = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const float d = s.given_line_density[h];
    if (s.line[h] == line_none) wrong += d != 0;
    if (!s.mesh.is_boundary(h)) wrong += d != s.given_line_density[s.mesh.twin[h]];
    after[d] += s.line[h] != line_none ? edge_length(s, h) : 0;
  }
  CHECK(wrong == 0);
  CHECK(after.size() == 5);
  for (const auto& [density, length] : before) CHECK(after[density] == doctest::Approx(length).epsilon(1e-12));
}

TEST_CASE("refine: what is fine already stays as it is") {
  Prepared p("sphere", 320);
  p.features();
  const VertexId* origin = p.surface.mesh.origin.data;
  const std::size_t used = p.block.arena.used();
  refine_all(p, 1e-3);
  CHECK(p.surface.mesh.origin.data == origin);
  CHECK(p.surface.mesh.face_count() == 320);
  CHECK(p.block.arena.used() == used);
}

TEST_CASE("refine: twelve triangles become no more than a few for each wished one") {
  Prepared p("cube", 12);
  p.features(30);
  check_refined(p, 25);
  CHECK(p.surface.mesh.face_count() < 4 * 24 / (std::sqrt(3.0) / 4 / (25 * 25)));
}

TEST_CASE("refine: any arena does or fails cleanly") {
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 400000; bytes += 4001) {
    Prepared p("cube", 12);
    p.features(30);
    support::Block block(bytes);
    Refine refine;
    Status status = refine.begin(p.surface, 4, 1.25, block.arena);
    const std::size_t back = block.arena.mark().back;
    while (status.is_ok() && !refine.done()) status = refine.step(p.surface, block.arena);
    REQUIRE(block.arena.mark().back == back);
    if (enough) CHECK(status.is_ok());
    enough = status.is_ok();
    if (!enough) CHECK(status == Status::out_of_memory);
  }
  CHECK(enough);
}
