#include <doctest/doctest.h>

#include <cmath>
#include <map>

#include "support/checker.h"

using checker::surface_of;

namespace {

checker::Promise promise_of(const shapes::ShapeInfo& info) {
  checker::Promise promise;
  promise.genus = info.genus;
  promise.loops = info.loops;
  promise.components = info.components;
  if (info.loops == 0) promise.volume_sign = 1;
  return promise;
}

shapes::Shape made(const std::string& name, std::size_t triangles) {
  shapes::Shape shape;
  CHECK(shapes::make(name, triangles, shape));
  return shape;
}

std::size_t sharp_edges(const measure::Surface& surface) {
  std::size_t count = 0;
  for (const auto& edge : measure::feature_lines(surface).edges) count += edge.boundary ? 0 : 1;
  return count;
}

}  // namespace

TEST_CASE("shapes: each has the topology that it states, at every size") {
  for (const shapes::ShapeInfo& info : shapes::list()) {
    for (const std::size_t size : {std::size_t(0), std::size_t(300), std::size_t(7000), std::size_t(30000)}) {
      CAPTURE(info.name);
      CAPTURE(size);
      const shapes::Shape shape = made(info.name, size);
      CHECK(checker::faults(surface_of(shape), promise_of(info)) == "");
    }
  }
}

TEST_CASE("shapes: about as many triangles as asked for") {
  for (const shapes::ShapeInfo& info : shapes::list()) {
    CAPTURE(info.name);
    const double share = double(made(info.name, 100000).triangles.size() / 3) / 100000;
    CHECK(share > 0.6);
    CHECK(share < 1.6);
  }
}

TEST_CASE("shapes: the triangles are fit to be remeshed, and none pass through each other") {
  for (const shapes::ShapeInfo& info : shapes::list()) {
    CAPTURE(info.name);
    const shapes::Shape shape = made(info.name, 20000);
    const measure::Quality q = measure::quality(surface_of(shape));
    CHECK(q.q_mean > 0.68);
    CHECK(q.least_angle > 12);
    const measure::Crossings crossings = measure::crossings(surface_of(shape));
    CHECK(crossings.apart == 0);
    CHECK(crossings.at_vertex == 0);
  }
}

TEST_CASE("shapes: the smooth ones have no sharp edge, the others have them where they belong") {
  for (const char* name : {"sphere", "torus", "knot", "head", "lattice", "tube200", "disk", "saddle"}) {
    CAPTURE(name);
    CHECK(sharp_edges(surface_of(made(name, 20000))) == 0);
  }
  CHECK(sharp_edges(surface_of(made("cube", 12 * 100))) == 12 * 10);
  CHECK(sharp_edges(surface_of(made("tetrahedron", 4 * 64))) == 6 * 8);
  CHECK(measure::feature_lines(surface_of(made("cube", 1200))).corners.size() == 8);
  CHECK(measure::feature_lines(surface_of(made("saddle", 2000))).corners.size() == 4);
}

TEST_CASE("shapes: the bracket's creases, corners and planes are exact") {
  const shapes::Shape shape = made("bracket", 20000);
  const int steps = 13, levels = 7, half = 10;  // of the grid at this size
  const int outlines = 2 * (10 * steps + 2 * levels + 4 * half), swept = 5 * 2 * steps,
            rims = 4 * 8 * steps + 16 * steps;
  const measure::FeatureLines lines = measure::feature_lines(surface_of(shape));
  CHECK(lines.edges.size() == std::size_t(outlines + swept + rims));
  CHECK(lines.corners.size() == 10);
  const double planes[3][4] = {{0, 0.5, 4, 4}, {0, 2, 2, 2}, {0, 0.5, 3, 3}};
  std::size_t near = 0, exact = 0;
  for (std::size_t i = 0; i < shape.positions.size(); ++i) {
    for (double plane : planes[i % 3]) {
      near += std::fabs(shape.positions[i] - plane) < 1e-9 ? 1 : 0;
      exact += shape.positions[i] == plane ? 1 : 0;
    }
  }
  CHECK(near > 9000);
  CHECK(near == exact);
  const double pi = std::acos(-1.0), fillet = (1 - pi / 4) * 0.25 * 2;
  const double volume = 4 * 2 * 0.5 + 2.5 * 2 * 0.5 + fillet - 0.5 * pi * (4 * 0.0625 + 0.36);
  CHECK(measure::quality(surface_of(shape)).volume == doctest::Approx(volume).epsilon(0.002));
}

TEST_CASE("shapes: measures of the round ones come near their formulas") {
  const double pi = std::acos(-1.0);
  const measure::Quality sphere = measure::quality(surface_of(made("sphere", 50000)));
  CHECK(sphere.volume == doctest::Approx(4 * pi / 3).epsilon(0.001));
  CHECK(sphere.area == doctest::Approx(4 * pi).epsilon(0.001));
  const measure::Quality torus = measure::quality(surface_of(made("torus", 50000)));
  CHECK(torus.volume == doctest::Approx(2 * pi * pi * 0.16).epsilon(0.001));
  const shapes::Shape tube = made("tube200", 20000);
  CHECK(measure::diagonal(surface_of(tube)) == doctest::Approx(std::sqrt(200.0 * 200 + 2)).epsilon(1e-4));
}

TEST_CASE("shapes: families take any number, other names are refused") {
  shapes::ShapeInfo info;
  for (const char* name : {"plate1", "plate7", "plate53", "lattice1", "lattice9", "lattice33", "lattice77"}) {
    CAPTURE(name);
    CHECK(shapes::find(name, info));
    CHECK(checker::faults(surface_of(made(name, 3000)), promise_of(info)) == "");
  }
  shapes::Shape shape;
  for (const char* name : {"", "spher", "sphere2", "plate0", "plate-3", "platex", "lattice0", "lattice99999"}) {
    CAPTURE(name);
    CHECK_FALSE(shapes::find(name, info));
    CHECK_FALSE(shapes::make(name, 1000, shape));
  }
}

TEST_CASE("shapes: the same bytes on every machine") {
  const std::map<std::string, std::uint64_t> golden = {
      {"sphere", 0x2C0DC14DD81BE190u},    {"torus", 0x16DBAEB2F25D3B8Bu},         {"knot", 0x672AF47983A04E99u},
      {"head", 0x758A12E8A92A7907u},      {"bracket", 0x3601B6E9968B9741u},       {"tetrahedron", 0x41B4B7D69CBC667Eu},
      {"cube", 0x3284F17063E27EF5u},      {"cylinder_open", 0xF89BC7A2CE09BE2Cu}, {"disk", 0x7F958D942147EA8Eu},
      {"saddle", 0xCCD74F51D29DCC68u},    {"spheres500", 0xD45C1723BE5A4BC5u},    {"tube200", 0x9010B3267372A485u},
      {"plate", 0x86BAACCCA76D988Fu},     {"plate400", 0x76FA250A16CA3591u},      {"lattice", 0xBBA8AC5257946AD1u},
      {"lattice10", 0x0BE4B27C336856E2u}, {"lattice50", 0x7CEB4DC52B96A4B9u},     {"lattice150", 0x8204E82DED7DEA52u},
  };
  for (const shapes::ShapeInfo& info : shapes::list()) {
    CAPTURE(info.name);
    const auto entry = golden.find(info.name);
    const std::uint64_t expected = entry == golden.end() ? 0 : entry->second;
    CHECK(checker::hash_of(made(info.name, 2000)) == expected);
  }
}
