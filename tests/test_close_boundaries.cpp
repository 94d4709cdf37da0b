// Holes that the sampling is too coarse for: which of them close, what closes them, and what stays as it was.
#include "surface/close_boundaries.h"

#include <algorithm>
#include <cmath>

#include "mesh/validate.h"
#include "support/holes.h"
#include "surface/line_density.h"
#include "surface/refine.h"

using namespace isolod;
using support::Prepared;
using support::without;

namespace {

double length_of(const Surface& surface, const std::vector<HalfedgeId>& loop) {
  double sum = 0;
  for (HalfedgeId h : loop) sum += edge_length(surface, h);
  return sum;
}

ClosedLoops close(Prepared& p, double line_rate, double corner_angle = 30) {
  ClosedLoops loops;
  const std::size_t scratch = p.block.arena.mark().back;
  REQUIRE(close_boundaries(p.surface, {line_rate, corner_angle}, loops, p.block.arena).is_ok());
  CHECK(p.block.arena.mark().back == scratch);
  return loops;
}

Topology topology_of(Prepared& p) {
  Topology topology;
  REQUIRE(measure_topology(p.surface.mesh, topology, p.block.arena).is_ok());
  return topology;
}

/// Everything that must hold of a surface, whatever was closed.
void check_sound(Prepared& p) {
  const Surface& s = p.surface;
  Finding finding;
  find_halfedge_defect(s.mesh, finding);
  CHECK(finding.defect == Defect::none);
  std::vector<double> positions;
  for (VertexId v : Ids<VertexId>(s.mesh.vertex_count())) {
    const Vec3 at = s.position(v);
    positions.insert(positions.end(), {at.x, at.y, at.z});
  }
  REQUIRE(
      find_defect(s.mesh.origin, {positions.data(), positions.size()}, s.mesh.vertex_count(), finding, p.block.arena)
          .is_ok());
  CHECK(finding.defect == Defect::none);
  CHECK(s.line.count == s.mesh.halfedge_count());
  CHECK(s.source_face.count == s.mesh.face_count());
  CHECK(s.corner.count == s.mesh.vertex_count());
  CHECK(s.source_vertex.count + s.midpoint.count == s.mesh.vertex_count());
  int wrong = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const HalfedgeId t = s.mesh.twin[h];
    wrong += ((s.line[h] & line_boundary) != 0) != t.is_none();
    if (t.is_none()) continue;
    wrong += s.line[h] != s.line[t] || s.given_density(h) != s.given_density(t);
    if (s.line[h] == line_none) wrong += s.density(h) != s.density(next(t));  // one value a wedge
  }
  CHECK(wrong == 0);
  for (std::uint8_t c : s.corner) CHECK(c <= 1);
}

/// Old faces come first and are what they were, but for boundary bits and wedges that became one.
struct Before {
  explicit Before(const Prepared& p)
      : origin(p.surface.mesh.origin.begin(), p.surface.mesh.origin.end()),
        line(p.surface.line.begin(), p.surface.line.end()),
        source(p.surface.source_face.begin(), p.surface.source_face.end()) {}

  void check_kept(const Surface& s) const {
    CHECK(std::equal(origin.begin(), origin.end(), s.mesh.origin.begin()));
    CHECK(std::equal(source.begin(), source.end(), s.source_face.begin()));
    int wrong = 0;
    for (std::size_t h = 0; h < line.size(); ++h) wrong += ((line[h] ^ s.line[h]) & ~line_boundary) != 0;
    CHECK(wrong == 0);
  }

  std::vector<VertexId> origin;
  std::vector<std::uint8_t> line;
  std::vector<std::uint32_t> source;
};

/// A sphere with a small hole at the top and a larger one at the bottom.
shapes::Shape two_holes() {
  return without(support::made("sphere", 5120), [](Vec3 p) { return p.z > 0.985 || p.z < -0.9; });
}

/// The rate at which the shortest loop wishes for so many samples.
double rate_for_shortest(const Surface& surface, double samples) {
  double least = 1e300;
  for (const auto& loop : support::naive_loops(surface)) least = smaller(least, length_of(surface, loop));
  return samples / least;
}

}  // namespace

TEST_CASE("close_boundaries: the hole below three samples closes, the other one stays, at any scale") {
  for (const double scale : {1.0, 1e-9, 1e9}) {
    CAPTURE(scale);
    Prepared p(support::scaled(two_holes(), scale));
    p.features();
    REQUIRE(topology_of(p).boundary_loops == 2);
    const Before before(p);
    const DensityIntegrals old = integrate_density(p.surface);
    const ClosedLoops loops = close(p, rate_for_shortest(p.surface, 2));
    CHECK(loops.closed == 1);
    CHECK(loops.kept == 0);
    CHECK(loops.folded == 0);
    check_sound(p);
    before.check_kept(p.surface);
    CHECK(topology_of(p).boundary_loops == 1);
    const DensityIntegrals now = integrate_density(p.surface);
    CHECK(now.euler_characteristic == old.euler_characteristic + 1);
    CHECK(now.boundary < old.boundary);
    int inwards = 0;
    for (std::uint32_t f = static_cast<std::uint32_t>(before.source.size()); f < p.surface.mesh.face_count(); ++f) {
      inwards += area_vector(p.surface, FaceId{f}).z <= 0;
      bool is_beside = false;  // the caller's triangle is the one across the rim
      for (std::uint32_t k = 0; k < 3; ++k) {
        const FaceId other = face(p.surface.mesh.twin[halfedge(FaceId{f}, k)]);
        is_beside = is_beside || (other.value < before.source.size() &&
                                  p.surface.source_face[other] == p.surface.source_face[FaceId{f}]);
      }
      CHECK(is_beside);
    }
    CHECK(inwards == 0);
  }
}

TEST_CASE("close_boundaries: where nothing is small, or nothing is open, nothing is touched") {
  for (const bool open : {true, false}) {
    Prepared p(open ? two_holes() : support::made("sphere", 320));
    p.features();
    const VertexId* origin = p.surface.mesh.origin.data;
    const std::size_t used = p.block.arena.used();
    const ClosedLoops loops = close(p, open ? rate_for_shortest(p.surface, 2.5) : 1);
    CHECK(loops.closed + loops.kept == 0);
    CHECK(p.surface.mesh.origin.data == origin);
    CHECK(p.block.arena.used() == used);
  }
}

TEST_CASE("close_boundaries: three is enough, and the error of rounding goes from loop to loop") {
  for (const std::string name : {"plate9", "plate12", "plate30"}) {
    for (double samples = 2.05; samples < 3.2; samples += 0.1) {
      CAPTURE(name);
      CAPTURE(samples);
      Prepared p(name, 6000);
      p.features();
      const double rate = rate_for_shortest(p.surface, samples);
      std::vector<HalfedgeId> closing;
      double error = 0;
      for (const auto& loop : support::naive_loops(p.surface)) {
        const double wish = rate * length_of(p.surface, loop) + error, rounded = std::floor(wish + 0.5);
        error = wish - rounded;
        if (rounded < 3) closing.push_back(loop.front());
      }
      const std::size_t loops = topology_of(p).boundary_loops;
      CHECK(close(p, rate).closed == closing.size());
      CHECK(topology_of(p).boundary_loops == loops - closing.size());
      check_sound(p);
      int open = 0;
      for (HalfedgeId h : closing) open += p.surface.mesh.is_boundary(h);
      CHECK(open == 0);
    }
  }
}

TEST_CASE("close_boundaries: some of equal loops close and others do not, so that the boundary keeps its density") {
  Prepared p("plate30", 12000);
  p.features();
  const std::uint32_t closed = close(p, rate_for_shortest(p.surface, 2.5)).closed;
  CHECK(closed > 10);
  CHECK(closed < 20);
}

TEST_CASE("close_boundaries: a flat cap adds the area of its hole, and its corners go") {
  for (const bool bent : {false, true}) {
    std::set<std::array<std::uint32_t, 2>> cells = {{4, 4}, {5, 4}, {6, 4}};
    if (bent) cells.insert({{6, 5}, {6, 6}, {5, 6}, {4, 6}});
    Prepared p(support::grid(12, cells));
    p.features();
    REQUIRE(integrate_density(p.surface).corner_count == 4 + (bent ? 8 : 4));
    CHECK(close(p, 2.0 / double(2 * cells.size() + 2)).closed == 1);
    check_sound(p);
    const DensityIntegrals now = integrate_density(p.surface);
    CHECK(now.surface == doctest::Approx(144).epsilon(1e-12));
    CHECK(now.corner_count == 4);
    CHECK(now.boundary == doctest::Approx(48));
  }
}

TEST_CASE("close_boundaries: holes that touch in a vertex are one rim that touches itself, and close as one") {
  for (const double scale : {1.0, 1e-9, 1e9}) {
    Prepared p(support::scaled(support::grid(12, {{4, 4}, {5, 5}, {8, 3}}), scale));
    p.features();
    REQUIRE(p.surface.mesh.vertex_count() == 170);  // repair cut the vertex between the two
    REQUIRE(topology_of(p).boundary_loops == 3);
    const ClosedLoops closed = close(p, 0.25 / scale);
    check_sound(p);
    CHECK(closed.closed == 2);
    CHECK(topology_of(p).boundary_loops == 1);
    CHECK(integrate_density(p.surface).surface < 147 * scale * scale);
  }
}

TEST_CASE("close_boundaries: both ends of a tube close, and it is a sphere") {
  Prepared p("cylinder_open", 8000);
  p.features();
  CHECK(close(p, rate_for_shortest(p.surface, 2.2)).closed == 2);
  check_sound(p);
  CHECK(topology_of(p).boundary_loops == 0);
  CHECK(topology_of(p).genus == 0);
  CHECK(integrate_density(p.surface).euler_characteristic == 2);
  CHECK(integrate_density(p.surface).lines == 0);
}

TEST_CASE("close_boundaries: a sheet keeps its rim, however few samples that gets") {
  for (const std::string name : {"disk", "saddle"}) {
    Prepared p(name, 600);
    p.features();
    for (const double samples : {0.1, 1.0, 2.4}) {
      const ClosedLoops loops = close(p, rate_for_shortest(p.surface, samples));
      CHECK(loops.closed == 0);
      CHECK(loops.kept == 1);
    }
    CHECK(topology_of(p).boundary_loops == 1);
  }
  Prepared ring(without(support::made("disk", 2000), [](Vec3 p) { return length(p) < 0.5; }));
  ring.features();
  const ClosedLoops loops = close(ring, 0.05);  // both loops are small, the inner one is a hole
  CHECK(loops.closed == 1);
  CHECK(loops.kept == 1);
  CHECK(topology_of(ring).boundary_loops == 1);
}

TEST_CASE("close_boundaries: a rim that shall have few samples is none the less no hole") {
  Prepared p("disk", 600);
  p.features();
  std::vector<float> given(p.surface.mesh.halfedge_count(), 0);
  for (HalfedgeId h : Ids<HalfedgeId>(given.size())) given[h.value] = p.surface.mesh.is_boundary(h) ? 1e-3F : 0;
  p.surface.given_line_density = {given.data(), given.size()};
  CHECK(close(p, 10).kept == 1);
}

TEST_CASE("close_boundaries: the last loop stays where the closed surface could not hold its topology") {
  for (const std::string name : {"sphere", "torus"}) {
    const double fewest = name == "sphere" ? 4 : 7, euler = name == "sphere" ? 2 : 0;
    const shapes::Shape shape = support::made(name, 5120);
    const Vec3 pole = support::corner_at(shape, 0);
    const shapes::Shape open = without(shape, [&](Vec3 p) { return distance(p, pole) < 0.15; });
    Prepared p(open);
    p.features();
    REQUIRE(topology_of(p).boundary_loops == 1);
    const double area = integrate_density(p.surface).surface;
    const double rate = std::sqrt((fewest - euler) / area * std::sqrt(3.0) / 2);
    REQUIRE(rate * length_of(p.surface, support::naive_loops(p.surface)[0]) < 2.4);
    CHECK(close(p, rate * 0.97).kept == 1);
    CHECK(topology_of(p).boundary_loops == 1);
    CHECK(close(p, rate * 1.03).closed == 1);
    CHECK(topology_of(p).boundary_loops == 0);
    check_sound(p);
  }
}

TEST_CASE("close_boundaries: of two small loops one stays where the closed surface could not hold its topology") {
  for (const double part : {0.97, 1.03}) {
    Prepared p("cylinder_open", 8000);
    p.features();
    const double caps = 2 * 3.14159265358979323846, area = integrate_density(p.surface).surface + caps;
    const double rate = part * std::sqrt(2 / area / samples_a_square);  // two samples and chi are a tetrahedron
    REQUIRE(rate * caps < 2.2);
    const ClosedLoops loops = close(p, rate);
    CHECK(loops.closed == (part < 1 ? 1 : 2));
    CHECK(loops.kept == (part < 1 ? 1 : 0));
    CHECK(topology_of(p).boundary_loops == loops.kept);
    check_sound(p);
  }
}

TEST_CASE("close_boundaries: components are judged each for itself") {
  shapes::Shape both = two_holes();
  const shapes::Shape sheet = support::scaled(support::grid(3), 0.01);
  const auto base = static_cast<std::uint32_t>(both.positions.size() / 3);
  both.positions.insert(both.positions.end(), sheet.positions.begin(), sheet.positions.end());
  for (std::uint32_t v : sheet.triangles) both.triangles.push_back(base + v);
  Prepared p(both);
  p.features();
  double small = 0;
  for (const auto& loop : support::naive_loops(p.surface)) {
    const double here = length_of(p.surface, loop);
    if (here > 0.13 && here < 2) small = here;
  }
  const ClosedLoops loops = close(p, 2.2 / small);
  CHECK(loops.closed == 1);
  CHECK(loops.kept == 1);
  CHECK(topology_of(p).components == 2);
  CHECK(topology_of(p).boundary_loops == 2);
  check_sound(p);
}

TEST_CASE("close_boundaries: a slit without width stays") {
  shapes::Shape shape = support::grid(4);
  const auto copy = static_cast<std::uint32_t>(shape.positions.size() / 3);
  shape.positions.insert(shape.positions.end(), {2, 2, 0});
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3) {
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k) x += support::corner_at(shape, t + k).x / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      if (shape.triangles[t + k] == 2 * 5 + 2 && x > 2) shape.triangles[t + k] = copy;
    }
  }
  Prepared p(shape);
  p.features();
  REQUIRE(topology_of(p).boundary_loops == 2);
  const ClosedLoops loops = close(p, 0.4);
  CHECK(loops.closed == 0);
  CHECK(loops.kept == 1);
}

TEST_CASE("close_boundaries: densities are handed on, the middle has the mean of the rim") {
  shapes::Shape shape = support::grid(12, {{5, 5}});
  Prepared p(shape);
  std::vector<double> given;
  for (std::size_t i = 0; i < shape.positions.size(); i += 3)
    given.push_back(1 + shape.positions[i] + 0.5 * shape.positions[i + 1]);
  p.view.vertex_density = given.data();
  p.features().density(DensitySource::given);
  CHECK(close(p, 0.5).closed == 1);
  check_sound(p);
  const Surface& s = p.surface;
  REQUIRE(s.wedge_density.count == s.mesh.halfedge_count());
  int wrong = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const Vec3 at = s.position(s.mesh.origin[h]);
    wrong += absolute(s.density(h) - (1 + at.x + 0.5 * at.y) / 19) > 1e-6;
  }
  CHECK(wrong == 0);
  CHECK(s.mesh.vertex_count() == 170);
}

TEST_CASE("close_boundaries: a feature that ended at the hole ends in a dart, in one wedge with the mean of two") {
  // The line x = 6 with a hole in it: 1 to its left, 9 to its right.
  Prepared p(support::grid(12, {{5, 5}, {6, 5}}));
  std::vector<std::uint32_t> tags;
  for (std::uint32_t y = 0; y < 12; ++y) {
    if (y != 5) tags.insert(tags.end(), {6 * 13 + y, 6 * 13 + y + 1});
  }
  p.view.tagged_edges = tags.data();
  p.view.tagged_edge_count = tags.size() / 2;
  std::vector<double> given(p.view.triangle_count * 3);
  for (std::size_t c = 0; c < given.size(); ++c) {
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k) x += read_position(p.view, read_index(p.view, c - c % 3 + k)).x / 3;
    given[c] = x < 6 ? 1 : 9;
  }
  p.view.corner_density = given.data();
  p.features().density(DensitySource::given);
  CHECK(close(p, 0.3).closed == 1);
  check_sound(p);
  const Surface& s = p.surface;
  int darts = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const Vec3 at = s.position(s.mesh.origin[h]);
    const bool on_rim = at.x == 6 && (at.y == 5 || at.y == 6);
    if (on_rim) {
      CHECK(s.density(h) == doctest::Approx(5.0 / 9).epsilon(1e-6));
      CHECK(s.corner[s.mesh.origin[h]] == 1);
      darts += s.line[h] == line_tagged;
    } else if (at.x < 6 && at.y != 5.5) {
      CHECK(s.density(h) == doctest::Approx(1.0 / 9).epsilon(1e-6));
    }
  }
  CHECK(darts == 2);
  const DensityIntegrals sums = integrate_density(s);
  CHECK(sums.corner_count == 4 + 2 + 2);
}

TEST_CASE("close_boundaries: a tagged rim stays a line with its density; the rest of the rim gives up what it had") {
  Prepared p(support::grid(12, {{5, 5}}));
  const std::uint32_t tags[] = {5 * 13 + 5, 6 * 13 + 5, 0, 1};
  const double given[] = {0.25, 3};
  p.view.tagged_edges = tags;
  p.view.tagged_edge_count = 2;
  p.view.tagged_edge_density = given;
  p.features().density(DensitySource::uniform);
  CHECK(close(p, 0.5).closed == 1);
  check_sound(p);
  const Surface& s = p.surface;
  REQUIRE(s.given_line_density.count == s.mesh.halfedge_count());
  int tagged = 0, with_density = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    tagged += s.line[h] == line_tagged;
    with_density += s.given_density(h) > 0;
    if (s.line[h] == line_tagged) CHECK(edge_density(s, h) == 0.25);
  }
  CHECK(tagged == 2);
  CHECK(with_density == 3);
}

TEST_CASE("close_boundaries: what was closed refines, and samples see no boundary") {
  Prepared p(two_holes());
  p.features();
  const double rate = rate_for_shortest(p.surface, 2);
  close(p, rate);
  Refine refine;
  REQUIRE(refine.begin(p.surface, 40, 1.25, p.block.arena).is_ok());
  while (!refine.done()) REQUIRE(refine.step(p.surface, p.block.arena).is_ok());
  check_sound(p);
  CHECK(topology_of(p).boundary_loops == 1);
  p.chain();
  LineSamples lines;
  REQUIRE(sample_lines(p.surface, p.backbones, rate, 1000, lines, p.block.arena).is_ok());
  for (std::size_t b = 0; b < p.backbones.count(); ++b) CHECK(is_boundary(p.surface, p.backbones, b));
}

TEST_CASE("close_boundaries: twice the same, and the lowest halfedge counts, not where the loop is") {
  Prepared a("plate30", 6000), b("plate30", 6000);
  a.features();
  b.features();
  const double rate = rate_for_shortest(a.surface, 2.5);
  CHECK(close(a, rate).closed == close(b, rate).closed);
  CHECK(std::equal(a.surface.mesh.origin.begin(), a.surface.mesh.origin.end(), b.surface.mesh.origin.begin()));
  CHECK(std::equal(a.surface.line.begin(), a.surface.line.end(), b.surface.line.begin()));
  for (std::size_t i = 0; i < a.surface.midpoint.count; ++i) {
    CHECK(distance(a.surface.midpoint[i], b.surface.midpoint[i]) == 0);
  }
}

TEST_CASE("close_boundaries: any arena does or fails cleanly") {
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 120000; bytes += 997) {
    Prepared p(without(support::made("sphere", 320), [](Vec3 q) { return q.z > 0.9; }));
    std::vector<double> given(p.view.vertex_count, 1);
    p.view.vertex_density = given.data();
    p.features().density(DensitySource::given);
    support::Block block(bytes + 1);
    ClosedLoops loops;
    const Status status = close_boundaries(p.surface, {0.5, 30}, loops, block.arena);
    REQUIRE(block.arena.mark().back == 0);
    if (enough) CHECK(status.is_ok());
    enough = status.is_ok();
    if (enough) CHECK(loops.closed == 1);
    if (!enough) CHECK(status == Status::out_of_memory);
  }
  CHECK(enough);
}
