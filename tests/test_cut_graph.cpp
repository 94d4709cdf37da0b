#include "atlas/cut_graph.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <vector>

#include "isolod/io.h"
#include "mesh/repair.h"
#include "mesh/validate.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;
using support::Piece;
using support::Prepared;
using support::Random;
using support::Soup;

namespace {

using Mask = std::vector<std::uint8_t>;

Span<std::uint8_t> span(Mask& mask) { return {mask.data(), mask.size()}; }

/// A surface with its lengths, and a large block of its own.
struct Ground {
  explicit Ground(const Surface& from, double factor = 1) : surface(from) {
    length.resize(surface.mesh.halfedge_count());
    REQUIRE(measure_edges(surface, {factor}, {length.data(), length.size()}).is_ok());
  }
  Span<const double> lengths() const { return {length.data(), length.size()}; }
  Mask cut(const CutGraphOptions& options = {}) {
    Mask mask(length.size(), 77);
    support::Block dirty;
    Span<unsigned char> all;
    REQUIRE(dirty.arena.scratch(std::size_t{1} << 20, all).is_ok());
    for (std::size_t i = 0; i < all.count; ++i) all[i] = static_cast<unsigned char>(i * 31 + 7);
    dirty.arena.rewind_scratch({});
    REQUIRE(make_cut(surface, lengths(), options, span(mask), dirty.arena).is_ok());
    CHECK(dirty.arena.used() == 0);
    return mask;
  }
  double total(const Mask& mask) const { return cut_length(surface, lengths(), {mask.data(), mask.size()}); }

  const Surface& surface;
  std::vector<double> length;
};

struct Sets {
  explicit Sets(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) { return parent[i] == i ? i : parent[i] = find(parent[i]); }
  void unite(std::size_t a, std::size_t b) { parent[find(a)] = find(b); }
  std::size_t count(const std::function<bool(std::size_t)>& among) {
    std::set<std::size_t> roots;
    for (std::size_t i = 0; i < parent.size(); ++i) {
      if (among(i)) roots.insert(find(i));
    }
    return roots.size();
  }
  std::vector<std::size_t> parent;
};

/// The surface cut open, counted anew: a vertex for every class of corners that uncut edges hold together.
struct Open {
  Open(const Surface& surface, const Mask& cut) {
    const Halfedges& mesh = surface.mesh;
    const std::size_t n = mesh.halfedge_count();
    Sets corners(n), faces(mesh.face_count()), components(mesh.face_count()), rim(n);
    std::size_t inner = 0, outer = 0;
    for (std::uint32_t h = 0; h < n; ++h) {
      const HalfedgeId t = mesh.twin[HalfedgeId{h}];
      symmetric = symmetric && cut[h] == (t.is_none() ? 0 : cut[t.value]) && cut[h] <= 1;
      if (!t.is_none()) components.unite(h / 3, t.value / 3);
      if (t.is_none() || cut[h] != 0) {
        ++outer;
        continue;
      }
      ++inner;
      faces.unite(h / 3, t.value / 3);
      corners.unite(h, next(t).value);
      corners.unite(next(HalfedgeId{h}).value, t.value);
    }
    const auto all = [](std::size_t) { return true; };
    vertices = corners.count(all);
    edges = inner / 2 + outer;
    pieces = faces.count(all);
    parts = components.count(all);
    for (std::uint32_t h = 0; h < n; ++h) {
      if (mesh.is_boundary(HalfedgeId{h}) || cut[h] != 0) {
        rim.unite(corners.find(h), corners.find(next(HalfedgeId{h}).value));
      }
    }
    std::set<std::size_t> with_rim;
    std::set<std::size_t> rims;
    for (std::uint32_t h = 0; h < n; ++h) {
      if (!mesh.is_boundary(HalfedgeId{h}) && cut[h] == 0) continue;
      rims.insert(rim.find(corners.find(h)));
      with_rim.insert(faces.find(h / 3));
    }
    loops = rims.size();
    all_have_rims = with_rim.size() == pieces;
    characteristic = long(vertices) - long(edges) + long(mesh.face_count());
  }
  bool planar() const { return symmetric && all_have_rims && characteristic + long(loops) == 2 * long(pieces); }
  /// As the header promises: no component falls apart.
  bool good() const { return planar() && pieces == parts; }

  bool symmetric = true, all_have_rims = false;
  std::size_t vertices = 0, edges = 0, pieces = 0, parts = 0, loops = 0;
  long characteristic = 0;
};

std::size_t edge_count(const Mask& cut) { return std::size_t(std::count(cut.begin(), cut.end(), 1)) / 2; }

/// The torus of seven vertices: every two of them share an edge. At random places, which cross.
Soup seven_vertices(std::uint64_t seed) {
  Soup soup;
  Random random(seed);
  for (std::uint32_t v = 0; v < 7; ++v) soup.vertex(random.unit(), random.unit(), random.unit());
  for (std::uint32_t v = 0; v < 7; ++v) {
    soup.face(v, (v + 1) % 7, (v + 3) % 7);
    soup.face(v, (v + 3) % 7, (v + 2) % 7);
  }
  return soup;
}

/// The shortest cut that leaves a disk, of all sets of edges.
double shortest_cut(const Ground& ground) {
  const Halfedges& mesh = ground.surface.mesh;
  std::vector<std::uint32_t> edges;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (h < mesh.twin[h]) edges.push_back(h.value);
  }
  REQUIRE(edges.size() == 21);
  double best = 1e30;
  for (std::uint32_t set = 0; set < 1u << 21; ++set) {
    double sum = 0;
    for (std::size_t e = 0; e < 21 && sum < best; ++e) sum += (set >> e & 1) != 0 ? ground.length[edges[e]] : 0;
    if (!(sum < best)) continue;
    Mask cut(mesh.halfedge_count(), 0);
    for (std::size_t e = 0; e < 21; ++e) {
      if ((set >> e & 1) != 0) cut[edges[e]] = cut[mesh.twin[HalfedgeId{edges[e]}].value] = 1;
    }
    const Open open(ground.surface, cut);
    if (open.good() && open.loops == 1) best = sum;
  }
  return best;
}

/// A torus without some of its triangles.
Soup punctured(std::uint32_t columns, std::uint32_t rows, const std::set<std::size_t>& gone) {
  const Soup whole = support::torus(columns, rows);
  Soup soup = whole;
  soup.triangles.clear();
  for (std::size_t t = 0; t < whole.triangles.size(); ++t) {
    if (gone.count(t) == 0) soup.triangles.push_back(whole.triangles[t]);
  }
  return soup;
}

Soup joined(const Soup& a, const Soup& b) {
  Soup soup = a;
  const auto base = static_cast<std::uint32_t>(a.positions.size());
  for (const Vec3& p : b.positions) soup.positions.push_back(p + Vec3{10000, 0, 0});
  for (const Soup::Triangle& t : b.triangles) soup.face(base + t[0], base + t[1], base + t[2]);
  return soup;
}

CutTopology measured(const Surface& surface, Mask& cut) {
  support::Block block(4096 + 64 * cut.size());  // small: it is asked for a million times
  CutTopology topology;
  REQUIRE(measure_cut(surface, span(cut), topology, block.arena).is_ok());
  CHECK(block.arena.used() == 0);
  return topology;
}

}  // namespace

TEST_CASE("cut graph: every shape becomes planar, straightened or not") {
  for (const char* name : {"sphere", "torus", "knot", "bracket", "tetrahedron", "cube", "cylinder_open", "disk",
                           "spheres500", "tube200", "plate", "lattice", "lattice10"}) {
    CAPTURE(name);
    Prepared p(name, 4000);
    Ground ground(p.surface);
    double before = 1e30;
    for (const std::uint32_t rounds : {0u, 1u, 2u, 30u}) {
      Mask cut = ground.cut({rounds, CutStart::retraction});
      const Open open(p.surface, cut);
      CHECK(open.good());
      CHECK(ground.total(cut) <= before * (1 + 1e-12));
      before = ground.total(cut);
      const CutTopology topology = measured(p.surface, cut);
      CHECK(topology.is_planar());
      CHECK(topology.pieces == open.pieces);
      CHECK(topology.components == open.parts);
      CHECK(topology.loops == open.loops);
      CHECK(topology.euler_characteristic == open.characteristic);
      CHECK(topology.closed_pieces == 0);
    }
  }
}

TEST_CASE("cut graph: straightening makes the spine much shorter, and is done when it says so") {
  for (const char* name : {"torus", "lattice", "bracket", "knot"}) {
    CAPTURE(name);
    Prepared p(name, 4000);
    Ground ground(p.surface);
    const Mask spine = ground.cut({0, CutStart::retraction}), straight = ground.cut();
    CHECK(ground.total(straight) < 0.8 * ground.total(spine));
    Mask again = straight;
    support::Block block;
    REQUIRE(make_cut(p.surface, ground.lengths(), {30, CutStart::given}, span(again), block.arena).is_ok());
    CHECK(again == straight);
    Mask later = spine;
    REQUIRE(make_cut(p.surface, ground.lengths(), {30, CutStart::given}, span(later), block.arena).is_ok());
    CHECK(later == straight);
  }
}

TEST_CASE("cut graph: near the shortest of all on the torus of seven vertices") {
  double worst = 1;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Piece piece(seven_vertices(seed));
    Ground ground(piece.surface);
    const double best = shortest_cut(ground);
    const double ratio = ground.total(ground.cut()) / best;
    CHECK(ratio > 1 - 1e-12);
    worst = std::max(worst, ratio);
  }
  CHECK(worst < 1.3);
}

TEST_CASE("cut graph: a flat torus is cut along two straight circles") {
  // Quads of unit length with one diagonal, as lengths alone: no torus in space has them.
  const std::uint32_t n = 12, m = 9;
  const Piece piece(support::torus(n, m));
  Ground ground(piece.surface);
  for (HalfedgeId h : Ids<HalfedgeId>(ground.length.size())) {
    const std::uint32_t a = piece.surface.mesh.origin[h].value, b = piece.surface.mesh.target(h).value;
    ground.length[h.value] = a / m != b / m && a % m != b % m ? 1.4142 : 1;
  }
  const Mask cut = ground.cut();
  CHECK(Open(piece.surface, cut).good());
  CHECK(ground.total(cut) == doctest::Approx(n + m).epsilon(0.06));
  CHECK(ground.total(cut) > 0.9 * (n + m));
}

TEST_CASE("cut graph: a sphere is cut between two vertices far apart, along two edges or more") {
  for (const char* name : {"sphere", "cube", "tube200", "tetrahedron"}) {
    CAPTURE(name);
    Prepared p(name, 1000);
    Ground ground(p.surface);
    const Mask cut = ground.cut();
    const Open open(p.surface, cut);
    CHECK(open.good());
    CHECK(open.loops == 1);
    CHECK(open.characteristic == 1);
    CHECK(edge_count(cut) >= 2);
  }
  Prepared sphere("sphere", 1000);
  Ground ground(sphere.surface);
  CHECK(ground.total(ground.cut()) > 0.97 * 3.14);
  Prepared tube("tube200", 2000);
  Ground along(tube.surface);
  CHECK(along.total(along.cut()) > 0.95 * diagonal(tube.surface));
}

TEST_CASE("cut graph: a tetrahedron is cut along two edges with a common end") {
  Prepared p("tetrahedron", 4);
  REQUIRE(p.surface.mesh.face_count() == 4);
  Ground ground(p.surface);
  const Mask cut = ground.cut();
  CHECK(edge_count(cut) == 2);
  const Open open(p.surface, cut);
  CHECK(open.good());
  CHECK(open.vertices == 5);
  CHECK(open.edges == 8);
}

TEST_CASE("cut graph: genus 0 with boundaries needs no cut") {
  for (const char* name : {"disk", "plate", "cylinder_open", "saddle"}) {
    Prepared p(name, 1000);
    Ground ground(p.surface);
    CHECK(edge_count(ground.cut()) == 0);
  }
  Soup one;
  one.vertex(0, 0, 0), one.vertex(1, 0, 0), one.vertex(0, 1, 0);
  one.face(0, 1, 2);
  const Piece piece(one);
  Ground ground(piece.surface);
  CHECK(edge_count(ground.cut()) == 0);
}

TEST_CASE("cut graph: a torus with holes becomes planar, the holes that the cut misses stay") {
  for (const std::set<std::size_t>& gone :
       {std::set<std::size_t>{0}, {10, 11}, {3, 70, 90}, {0, 1, 2, 3, 4, 5}, {5, 6, 50, 51, 52, 120, 140}}) {
    const Piece piece(punctured(12, 8, gone));
    Ground ground(piece.surface);
    const Mask cut = ground.cut();
    const Open open(piece.surface, cut);
    CHECK(open.good());
    Topology topology;
    support::Block block;
    REQUIRE(measure_topology(piece.surface.mesh, topology, block.arena).is_ok());
    CHECK(topology.genus == 1);
    CHECK(open.loops >= 1);
    CHECK(open.loops <= 1 + topology.boundary_loops);
    // The cut may pass holes at no cost, so that it is no longer than on the whole torus.
    const Piece whole(support::torus(12, 8));
    Ground on_whole(whole.surface);
    CHECK(ground.total(cut) <= 1.02 * on_whole.total(on_whole.cut()));
  }
}

TEST_CASE("cut graph: random holes, random tori") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t columns = 3 + random.below(5), rows = 3 + random.below(5);
    std::set<std::size_t> gone;
    for (std::uint32_t i = random.below(8); i > 0; --i) gone.insert(random.below(2 * columns * rows));
    Soup raw = punctured(columns, rows, gone).shuffled(random);
    for (Vec3& p : raw.positions) p = p + Vec3{90 * random.unit(), 90 * random.unit(), 90 * random.unit()};
    support::Block block;
    RepairedMesh repaired;
    RepairReport report;
    const MeshView view = raw.view();
    REQUIRE(repair(view, false, repaired, report, block.arena).is_ok());
    Surface surface;
    surface.view = &view;
    surface.source_vertex = repaired.source_vertex;
    surface.mesh.origin = repaired.triangles;
    REQUIRE(connect(surface.mesh, repaired.source_vertex.count, block.arena).is_ok());
    Ground ground(surface);
    CHECK(Open(surface, ground.cut({0, CutStart::retraction})).good());
    CHECK(Open(surface, ground.cut()).good());
  }
}

TEST_CASE("cut graph: each component has its own cut, as it would have alone") {
  const Soup torus = support::torus(10, 8);
  Soup cube;
  support::add_cube(cube, {0, 0, 0}, {256, 256, 256});
  const Piece both(joined(joined(torus, cube), torus));
  Ground ground(both.surface);
  const Mask cut = ground.cut();
  const Open open(both.surface, cut);
  CHECK(open.good());
  CHECK(open.pieces == 3);
  CHECK(open.loops == 3);
  const Piece alone(torus);
  Ground lone(alone.surface);
  const Mask expected = lone.cut();
  CHECK(std::equal(expected.begin(), expected.end(), cut.begin()));
  const std::size_t last = cut.size() - expected.size();
  CHECK(std::equal(expected.begin(), expected.end(), cut.begin() + long(last)));
}

TEST_CASE("cut graph: the same cut at every scale, piece by piece, and again") {
  for (const char* name : {"lattice", "sphere"}) {
    Prepared p(name, 3000);
    Ground ground(p.surface);
    const Mask cut = ground.cut();
    CHECK(ground.cut() == cut);
    for (const double scale : {0x1p-30, 0x1p30, 1e-9, 1e9}) {
      Prepared other(support::scaled(support::made(name, 3000), scale));
      Ground scaled(other.surface);
      const Mask same = scaled.cut();
      CHECK(Open(other.surface, same).good());
      if (scale == 0x1p-30 || scale == 0x1p30) CHECK(same == cut);
      CHECK(scaled.total(same) == doctest::Approx(scale * ground.total(cut)).epsilon(0.02));
    }
    support::Block block;
    CutGraph stage;
    Mask slowly(cut.size());
    REQUIRE(stage.begin(p.surface, ground.lengths(), {}, span(slowly), block.arena).is_ok());
    std::size_t steps = 0;
    for (; !stage.done(); ++steps) REQUIRE(stage.step().is_ok());
    REQUIRE(stage.finish().is_ok());
    CHECK(slowly == cut);
    CHECK(steps > 2);
  }
}

TEST_CASE("cut graph: seams run along features when these count for less") {
  Prepared p("bracket", 6000);
  p.features(40);
  const auto share = [&](double factor) {
    Ground ground(p.surface, factor);
    const Mask cut = ground.cut();
    CHECK(Open(p.surface, cut).good());
    double on = 0, all = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(cut.size())) {
      if (cut[h.value] == 0) continue;
      all += edge_length(p.surface, h);
      on += (p.surface.line[h] & line_feature) != 0 ? edge_length(p.surface, h) : 0;
    }
    return on / all;
  };
  const double plain = share(1), weighted = share(0.25);
  CAPTURE(plain);
  CAPTURE(weighted);
  CHECK(weighted > plain + 0.1);
}

TEST_CASE("cut graph: it is extended by the shortest way to a vertex") {
  Prepared p("sphere", 300);
  Ground ground(p.surface);
  const Mask cut = ground.cut();
  const Halfedges& mesh = p.surface.mesh;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    Mask longer = cut;
    support::Block block(1 << 17);
    REQUIRE(extend_cut(p.surface, ground.lengths(), v, span(longer), block.arena).is_ok());
    CHECK(block.arena.used() == 0);
    CHECK(Open(p.surface, longer).good());
    bool touched = false;
    visit_outgoing(mesh, v, [&](HalfedgeId h) { touched = touched || longer[h.value] != 0; });
    CHECK(touched);
    // Bellman and Ford from the cut.
    std::vector<double> distance(mesh.vertex_count(), 1e30);
    for (HalfedgeId h : Ids<HalfedgeId>(cut.size())) {
      if (cut[h.value] != 0) distance[mesh.origin[h].value] = 0;
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (HalfedgeId h : Ids<HalfedgeId>(cut.size())) {
        const double reach = distance[mesh.origin[h].value] + ground.length[h.value];
        if (reach < distance[mesh.target(h).value] - 1e-12) distance[mesh.target(h).value] = reach, changed = true;
      }
    }
    CHECK(ground.total(longer) - ground.total(cut) == doctest::Approx(distance[v.value]));
  }
}

TEST_CASE("cut graph: extended from a boundary, refused where there is nothing to extend") {
  Prepared disk("disk", 300);
  Ground ground(disk.surface);
  support::Block block;
  for (VertexId v : Ids<VertexId>(disk.surface.mesh.vertex_count())) {
    Mask cut(ground.length.size(), 0);
    REQUIRE(extend_cut(disk.surface, ground.lengths(), v, span(cut), block.arena).is_ok());
    CHECK(Open(disk.surface, cut).good());
    const bool on_boundary = disk.surface.mesh.is_boundary(disk.surface.mesh.outgoing[v]);
    CHECK((edge_count(cut) == 0) == on_boundary);
  }
  Prepared sphere("sphere", 300);
  Ground round(sphere.surface);
  Mask none_yet(round.length.size(), 0);
  const Status status = extend_cut(sphere.surface, round.lengths(), VertexId{5}, span(none_yet), block.arena);
  CHECK(status == Status::invalid_option);
  CHECK(status.value == 5);
  CHECK(edge_count(none_yet) == 0);
}

TEST_CASE("cut graph: the count sees what is wrong") {
  Prepared p("torus", 600);
  Ground ground(p.surface);
  const Mask cut = ground.cut();
  CHECK(measured(p.surface, *std::make_unique<Mask>(cut)).is_planar());
  Mask none(cut.size(), 0);
  CHECK_FALSE(measured(p.surface, none).is_planar());
  CHECK(measured(p.surface, none).closed_pieces == 1);
  for (HalfedgeId h : Ids<HalfedgeId>(cut.size())) {
    if (cut[h.value] == 0) continue;
    Mask less = cut;
    less[h.value] = less[p.surface.mesh.twin[h].value] = 0;
    const CutTopology topology = measured(p.surface, less);
    CHECK(topology.euler_characteristic == Open(p.surface, less).characteristic);
    CHECK(topology.loops == Open(p.surface, less).loops);
    CHECK(topology.is_planar() == Open(p.surface, less).planar());
  }
  Random random(3);
  for (int i = 0; i < 50; ++i) {
    Mask any(cut.size(), 0);
    for (std::uint32_t k = 0; k < 100; ++k) {
      const HalfedgeId h{random.below(cut.size())};
      any[h.value] = any[p.surface.mesh.twin[h].value] = 1;
    }
    const Open open(p.surface, any);
    const CutTopology topology = measured(p.surface, any);
    CHECK(topology.pieces == open.pieces);
    CHECK(topology.loops == open.loops);
    CHECK(topology.euler_characteristic == open.characteristic);
    CHECK(topology.is_planar() == open.planar());
  }
  // A cut that is given and does not do is told.
  Mask wrong(cut.size(), 0);
  support::Block block;
  CHECK(make_cut(p.surface, ground.lengths(), {5, CutStart::given}, span(wrong), block.arena) ==
        Status::invalid_result);
  CHECK(block.arena.used() == 0);
}

TEST_CASE("cut graph: too small an arena is a status, and the arena is as it was") {
  for (const char* name : {"torus", "sphere", "disk"}) {
    Prepared p(name, 60);
    Ground ground(p.surface);
    Mask cut(ground.length.size());
    std::size_t failures = 0;
    for (std::size_t bytes = 0;; bytes += 16) {
      support::Block block(bytes);
      const Status status = make_cut(p.surface, ground.lengths(), {}, span(cut), block.arena);
      CHECK(block.arena.used() == 0);
      if (status.is_ok()) break;
      CHECK(status == Status::out_of_memory);
      CHECK(status.value > bytes);
      ++failures;
    }
    CHECK(failures > 50);
    CHECK(cut == ground.cut());
    for (std::size_t bytes = 0;; bytes += 16) {
      support::Block block(bytes);
      const Status status = extend_cut(p.surface, ground.lengths(), VertexId{7}, span(cut), block.arena);
      CHECK(block.arena.used() == 0);
      if (status.is_ok()) break;
      CHECK(status == Status::out_of_memory);
    }
  }
}

TEST_CASE("cut graph: the models become planar") {
  const char* const folder = std::getenv("ISOLOD_MODELS");
  const std::string models = folder != nullptr ? folder : ISOLOD_TEST_DIRECTORY "/../../shared/models";
  for (const char* name :
       {"bff-punctured-torus.obj", "cgal-3torus.off", "cgal-anchor.off", "cgal-blobby_3cc.off", "cgal-couplingdown.off",
        "cgal-elephant.off", "cgal-knot2.off", "cgal-rotor_small.off", "gpjs-kitten.obj", "cgal-holes.off"}) {
    std::ifstream in(models + "/good/" + name, std::ios::binary);
    if (!in) continue;
    CAPTURE(name);
    const std::vector<unsigned char> file{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    support::Block block;
    LoadedMesh loaded;
    REQUIRE(read_mesh({file.data(), file.size()}, format_of_name(name), loaded, block.arena).is_ok());
    shapes::Shape shape;
    shape.positions.assign(loaded.positions.begin(), loaded.positions.end());
    shape.triangles.assign(loaded.triangles.begin(), loaded.triangles.end());
    Prepared p(shape);
    p.features(40);
    Ground ground(p.surface, 0.25);
    CHECK(Open(p.surface, ground.cut()).good());
  }
}
