#include "pipeline/make_atlas.h"

#include <doctest/doctest.h>

#include <map>
#include <set>

#include "sample/calibrate.h"
#include "support/exact.h"
#include "support/plane_shapes.h"

using namespace isolod;
using isolod_test::exact_orientation;
using support::Piece;
using support::Soup;

namespace {

struct Made {
  Atlas atlas;
  ChartMaps maps;
  std::vector<Vec2> uv;  // per halfedge
};

AtlasOptions options_for(const Piece& piece, std::uint32_t vertex_count) {
  const Rates rates = solve_rates(integrate_density(piece.surface), vertex_count, Calibration::corrected);
  AtlasOptions options;
  options.line_rate = rates.line;
  options.surface_rate = rates.surface;
  return options;
}

Status run(Surface& surface, const AtlasOptions& options, Made& made, Arena& arena) {
  MakeAtlas stage;
  Status status = stage.begin(surface, options, arena);
  while (status.is_ok() && !stage.done()) status = stage.step(arena);
  return status.is_ok() ? stage.finish(surface, made.atlas, made.maps, arena) : status;
}

Made make(Piece& piece, const AtlasOptions& options) {
  Made made;
  const ArenaMark mark = piece.block.arena.mark();
  REQUIRE(run(piece.surface, options, made, piece.block.arena).is_ok());
  CHECK(piece.block.arena.mark().back == mark.back);
  CHECK(made.atlas.place.empty());
  made.uv = support::map_by_halfedge(piece.surface, made.atlas, made.maps, piece.block.arena);
  return made;
}

std::vector<FaceId> faces_of(const Atlas& atlas, std::size_t chart) {
  const Span<const FaceId> faces = atlas.chart_faces(chart);
  return {faces.begin(), faces.end()};
}

void check_cover(const Piece& piece, const Atlas& atlas) {
  const std::size_t faces = piece.surface.mesh.face_count();
  REQUIRE(atlas.faces.count == faces);
  REQUIRE(atlas.start[0] == 0);
  REQUIRE(atlas.start[atlas.chart_count()] == faces);
  std::set<std::uint32_t> seen;
  for (std::uint32_t c = 0; c < atlas.chart_count(); ++c) {
    REQUIRE(atlas.start[c + 1] > atlas.start[c]);
    std::uint32_t place = 0;
    for (FaceId f : faces_of(atlas, c)) {
      REQUIRE(seen.insert(f.value).second);
      REQUIRE(atlas.chart_of_face[f] == c);
      REQUIRE(atlas.place[f] == place++);
    }
  }
}

/// Vertices of the chart, a number for each fan: sides that are glued share their numbers.
std::vector<std::uint32_t> fans_of(const Surface& surface, const Atlas& atlas, std::size_t chart) {
  const std::vector<FaceId> faces = faces_of(atlas, chart);
  std::vector<std::uint32_t> set(3 * faces.size());
  for (std::uint32_t i = 0; i < set.size(); ++i) set[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (set[i] != i) i = set[i];
    return i;
  };
  const auto corner = [&](HalfedgeId h) { return 3 * atlas.place[face(h)] + h.value % 3; };
  for (FaceId f : faces) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k), t = surface.mesh.twin[h];
      if (t.is_none() || atlas.chart_of_face[face(t)] != chart) continue;
      set[find(corner(h))] = find(corner(next(t)));
      set[find(corner(next(h)))] = find(corner(t));
    }
  }
  for (std::uint32_t& s : set) s = find(s);
  return set;
}

/// A chart's map, from the surface's side alone.
void check_map(const Piece& piece, const Made& made, std::size_t chart, double greatest_range) {
  const Surface& surface = piece.surface;
  const std::vector<FaceId> faces = faces_of(made.atlas, chart);
  REQUIRE(support::is_connected(surface.mesh, faces));
  const std::vector<std::uint32_t> fan = fans_of(surface, made.atlas, chart);
  std::map<std::uint32_t, Vec2> place;
  std::map<std::uint32_t, std::pair<double, double>> area;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    Vec2 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      corner[k] = made.uv[halfedge(faces[i], k).value];
      const auto known = place.insert({fan[3 * i + k], corner[k]});
      REQUIRE(distance(known.first->second, corner[k]) == 0);
    }
    REQUIRE(exact_orientation(corner[0], corner[1], corner[2]) > 0);
    for (std::uint32_t k = 0; k < 3; ++k) {
      auto& sums = area[fan[3 * i + k]];
      sums.first += face_area(surface, faces[i]);
      sums.second += 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
    }
  }
  double least = 1e300, greatest = 0;
  for (const auto& entry : area) {
    const double stretch = entry.second.first / entry.second.second;
    least = smaller(least, stretch), greatest = greater(greatest, stretch);
  }
  CHECK(greatest <= greatest_range * least * 1.001);
}

void check_seams(const Piece& piece, const Atlas& atlas, const std::vector<std::uint8_t>& before) {
  for (HalfedgeId h : Ids<HalfedgeId>(piece.surface.mesh.halfedge_count())) {
    const HalfedgeId t = piece.surface.mesh.twin[h];
    const bool seam = !t.is_none() && atlas.chart_of_face[face(h)] != atlas.chart_of_face[face(t)];
    REQUIRE(piece.surface.line[h] == (before[h.value] | (seam ? line_seam : line_none)));
  }
}

}  // namespace

TEST_CASE("make_atlas: every chart is connected, planar and mapped without a flip, and all faces are covered once") {
  for (const char* name : {"sphere", "torus", "lattice", "bracket", "knot", "tube200", "plate", "spheres500"}) {
    for (const std::uint32_t budget : {300u, 5000u}) {
      INFO(name << " for " << budget);
      Piece piece(support::made_soup(name, 3000), 40);
      const std::vector<std::uint8_t> lines(piece.surface.line.begin(), piece.surface.line.end());
      AtlasOptions options = options_for(piece, std::string(name) == "spheres500" ? 6000 : budget);
      options.flatten.greatest_stretch_range = 6;
      const Made made = make(piece, options);
      check_cover(piece, made.atlas);
      check_seams(piece, made.atlas, lines);
      for (std::size_t c = 0; c < made.atlas.chart_count(); ++c) {
        check_map(piece, made, c, 6);
        const ScratchScope scope(piece.block.arena);
        Chart chart;
        ChartTopology topology;
        REQUIRE(build_chart(piece.surface, made.atlas.chart_faces(c), made.atlas.chart_of_face, made.atlas.place, chart,
                            piece.block.arena)
                    .is_ok());
        REQUIRE(measure_chart(chart.mesh, topology, piece.block.arena).is_ok());
        CHECK(topology.is_planar());
      }
    }
  }
}

TEST_CASE("make_atlas: no chart has more faces or samples than it may") {
  Piece piece(support::made_soup("sphere", 3000));
  AtlasOptions options = options_for(piece, 3000);
  options.most_faces_per_chart = 37;
  options.samples_per_chart = 50;
  const Made made = make(piece, options);
  check_cover(piece, made.atlas);
  for (std::size_t c = 0; c < made.atlas.chart_count(); ++c) {
    double samples = 0;
    for (FaceId f : faces_of(made.atlas, c)) samples += options.surface_rate * face_density(piece.surface, f);
    CHECK(made.atlas.chart_faces(c).count <= 37);
    CHECK(samples <= 200);
  }
}

TEST_CASE("make_atlas: two runs give the same bits, and scaling by a power of two changes no chart") {
  Piece first(support::made_soup("bracket", 2500), 40), second(support::made_soup("bracket", 2500), 40);
  Piece tiny(support::made_soup("bracket", 2500).scaled(0x1p-30), 40);
  const Made a = make(first, options_for(first, 2000)), b = make(second, options_for(second, 2000));
  const Made c = make(tiny, options_for(tiny, 2000));
  REQUIRE(a.atlas.chart_count() == b.atlas.chart_count());
  for (FaceId f : Ids<FaceId>(first.surface.mesh.face_count())) {
    REQUIRE(a.atlas.chart_of_face[f] == b.atlas.chart_of_face[f]);
    REQUIRE(a.atlas.chart_of_face[f] == c.atlas.chart_of_face[f]);
  }
  for (std::size_t h = 0; h < a.uv.size(); ++h) {
    REQUIRE((a.uv[h].x == b.uv[h].x && a.uv[h].y == b.uv[h].y));
    REQUIRE((a.uv[h].x == c.uv[h].x * 0x1p30 && a.uv[h].y == c.uv[h].y * 0x1p30));
  }
}

TEST_CASE("make_atlas: very thin triangles do not stop it") {
  // A square whose lower side carries points a hair's breadth above it: a fan of needles.
  for (const double hair : {1e-4, 1e-8, 1e-12}) {
    Soup soup;
    soup.vertex(0, 0, 0), soup.vertex(1, 0, 0.1), soup.vertex(1, 1, 0), soup.vertex(0, 1, 0.1);
    for (int i = 1; i < 10; ++i) soup.vertex(i / 10.0, hair * i * (10 - i), 0.01 * i);
    soup.face(0, 1, 4);
    for (std::uint32_t i = 4; i < 12; ++i) soup.face(i, 1, i + 1), soup.face(i, i + 1, 2);
    soup.face(0, 4, 3), soup.face(4, 2, 3), soup.face(12, 1, 2);
    Piece piece(support::rotated(soup));
    INFO("hair " << hair);
    const Made made = make(piece, options_for(piece, 200));
    check_cover(piece, made.atlas);
    for (std::size_t c = 0; c < made.atlas.chart_count(); ++c) check_map(piece, made, c, 1e9);
  }
}

TEST_CASE("make_atlas: any arena does or fails cleanly") {
  Piece piece(support::made_soup("torus", 200));
  const AtlasOptions options = options_for(piece, 100);
  const std::vector<std::uint8_t> lines(piece.surface.line.begin(), piece.surface.line.end());
  std::vector<unsigned char> memory(std::size_t{1} << 17);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 656) {
    Arena arena(memory.data(), bytes);
    Made made;
    const ArenaMark mark = arena.mark();
    const Status status = run(piece.surface, options, made, arena);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    enough = enough || status.is_ok();
    if (status.is_ok()) CHECK(arena.mark().back == 0);
    arena.rewind_scratch(mark);
    arena.rewind_results(mark);
    CHECK(arena.used() == 0);
    for (std::size_t h = 0; h < lines.size() && !status.is_ok(); ++h) REQUIRE(piece.surface.line[h] == lines[h]);
  }
  CHECK(enough);
}
