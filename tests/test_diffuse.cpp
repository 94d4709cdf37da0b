#include "sample/diffuse.h"

#include <cmath>
#include <map>

#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Diffused {
  std::vector<std::uint32_t> count;  // per face
  double rate = 0;                   // R_s
  std::uint32_t total = 0;
};

/// A whole run of the sampling stages at this budget.
Diffused diffused(Prepared& p, std::uint32_t budget) {
  const Rates rates = solve_rates(integrate_density(p.surface), budget, Calibration::corrected);
  const std::uint32_t nodes = static_cast<std::uint32_t>(p.backbones.node.count);
  LineSamples lines;
  REQUIRE(budget >= nodes);
  REQUIRE(sample_lines(p.surface, p.backbones, rates.line, budget - nodes, lines, p.block.arena).is_ok());
  Diffused out;
  out.rate = rates.surface;
  out.total = budget - nodes - static_cast<std::uint32_t>(lines.place.count);
  out.count.assign(p.surface.mesh.face_count(), 12345);
  const std::size_t used = p.block.arena.used();
  FluencyReport report;
  REQUIRE(diffuse({&p.surface, &p.backbones, &lines, rates.surface, out.total}, {out.count.data(), out.count.size()},
                  report, p.block.arena)
              .is_ok());
  CHECK(p.block.arena.used() == used);
  return out;
}

std::uint64_t sum_of(const std::vector<std::uint32_t>& count) {
  std::uint64_t sum = 0;
  for (std::uint32_t c : count) sum += c;
  return sum;
}

}  // namespace

TEST_CASE("diffuse: the sum is exactly right for any budget") {
  for (const std::string name : {"sphere", "bracket", "plate", "cube", "lattice10", "saddle"}) {
    CAPTURE(name);
    Prepared p(name, 1500);
    p.features(name == "bracket" || name == "cube" ? 30 : 0).chain();
    for (std::uint32_t budget = 400; budget < 900; budget += 7) {
      const Diffused d = diffused(p, budget);
      REQUIRE(sum_of(d.count) == d.total);
    }
    for (const std::uint32_t budget : {1000U, 54321U, 1000000U}) {
      const Diffused d = diffused(p, budget);
      CHECK(sum_of(d.count) == d.total);
    }
  }
}

TEST_CASE("diffuse: tiny and huge numbers on surfaces without lines") {
  for (const std::string name : {"sphere", "lattice10", "spheres500"}) {
    Prepared p(name, 3000);
    p.features().chain();
    const LineSamples none{{p.backbones.start.data, 1}, {}};
    std::vector<std::uint32_t> count(p.surface.mesh.face_count());
    for (const std::uint32_t total : {0U, 1U, 2U, 3U, 499U, 500U, 501U, 100000U, 500000000U}) {
      CAPTURE(name);
      CAPTURE(total);
      for (const double rate : {1e-6, 1.0, 1e6}) {  // a rate that does not fit the total is corrected
        FluencyReport report;
        REQUIRE(
            diffuse({&p.surface, &p.backbones, &none, rate, total}, {count.data(), count.size()}, report, p.block.arena)
                .is_ok());
        CHECK(sum_of(count) == total);
      }
    }
  }
}

/// The mean of (count - wish)^2 / wish over 16 patches of the unit sphere: 1 is what independent random samples have.
double patch_error(Prepared& sphere, std::uint32_t budget) {
  const Diffused d = diffused(sphere, budget);
  std::map<int, double> wish, got;
  double area = 0, error = 0;
  for (FaceId f : Ids<FaceId>(sphere.surface.mesh.face_count())) {
    const Vec3 at = sphere.surface.position(sphere.surface.mesh.origin[halfedge(f, 0)]);
    const int patch = int(at.x > 0) + 2 * int(at.y > 0) + 4 * int(at.z > 0) + 8 * int(absolute(at.z) > 0.5);
    area += face_area(sphere.surface, f);
    wish[patch] += face_area(sphere.surface, f);
    got[patch] += d.count[f.value];
  }
  for (const auto& [patch, a] : wish) {
    const double wished = d.total * a / area;
    error += (got[patch] - wished) * (got[patch] - wished) / wished;
  }
  return error / double(wish.size());
}

TEST_CASE("diffuse: counts over patches follow the wish much closer than chance") {
  Prepared p("sphere", 20480);
  p.features().chain();
  for (const std::uint32_t budget : {2000U, 5000U, 20000U, 200000U}) {
    CAPTURE(budget);
    CHECK(patch_error(p, budget) < 0.15);
  }
}

TEST_CASE("diffuse: also where the mesh is much finer than the samples") {
  Prepared p("sphere", 80000);
  p.features().chain();
  for (const std::uint32_t budget : {500U, 1000U, 2000U}) {
    CAPTURE(budget);
    CHECK(patch_error(p, budget) < 0.5);
  }
}

TEST_CASE("diffuse: counts follow a density that varies") {
  Prepared p("head", 8000);
  p.features().density(DensitySource::curvature, 1.5, 3).chain();
  const Diffused d = diffused(p, 20000);
  const DensityIntegrals integrals = integrate_density(p.surface);
  std::map<int, double> wish, got;
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    const Vec3 at = p.surface.position(p.surface.mesh.origin[halfedge(f, 0)]);
    const int patch =
        int(at.x > 0) + 2 * int(at.y > 0) + 4 * int(at.z > 0) + 8 * int(p.surface.density(halfedge(f, 0)) > 20);
    wish[patch] += d.total * face_density(p.surface, f) / integrals.surface;
    got[patch] += d.count[f.value];
  }
  for (const auto& [patch, wished] : wish) CHECK(absolute(got[patch] - wished) < 3 + 0.6 * std::sqrt(wished));
}

TEST_CASE("diffuse: no face is more than the carried errors off, so a fine input gets at most one a face") {
  Prepared p("torus", 8000);
  p.features().chain();
  const Diffused d = diffused(p, 1000);
  std::size_t crowded = 0;
  for (std::uint32_t c : d.count) crowded += c > 1;
  CHECK(crowded == 0);
  const Diffused fine = diffused(p, 80000);  // ten a face; two children hand on at most half a sample each
  std::size_t far_off = 0;
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    far_off += absolute(fine.count[f.value] - fine.rate * face_area(p.surface, f)) > 2;
  }
  CHECK(far_off == 0);
}

TEST_CASE("diffuse: components get what they wish for, and one sample at most is carried between them") {
  Prepared p("spheres500", 20000);
  p.features().chain();
  const Diffused d = diffused(p, 17777);
  std::map<std::uint32_t, double> wish, got;
  const std::size_t faces_each = p.surface.mesh.face_count() / 500;
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    const std::uint32_t sphere = static_cast<std::uint32_t>(f.value / faces_each);
    wish[sphere] += face_area(p.surface, f);
    got[sphere] += d.count[f.value];
  }
  double area = 0, worst = 0;
  for (const auto& [sphere, a] : wish) area += a;
  for (const auto& [sphere, a] : wish) worst = greater(worst, absolute(got[sphere] - d.total * a / area));
  CHECK(worst <= 1.01);
}

TEST_CASE("diffuse: beside lines the samples on them are taken off, not far away") {
  for (const std::size_t triangles :
       {std::size_t(800), std::size_t(40000)}) {  // faces of a few samples, and the other way round
    CAPTURE(triangles);
    Prepared p("saddle", triangles);
    p.features().chain();
    const Diffused d = diffused(p, 4000);
    std::map<int, double> wish, got;  // nine parts, the middle one without boundary
    for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
      const Vec3 at = p.surface.position(p.surface.mesh.origin[halfedge(f, 0)]);
      const auto third = [](double x) { return x < -0.5 ? 0 : x < 0.5 ? 1 : 2; };
      const int part = third(at.x) + 3 * third(at.y);
      wish[part] += d.rate * face_area(p.surface, f);
      got[part] += d.count[f.value];
    }
    CHECK(absolute(got[4] - wish[4]) < 0.03 * wish[4]);
    for (const int part : {0, 1, 2, 3, 5, 6, 7, 8}) {
      CHECK(got[part] < wish[part]);
      CHECK(got[part] > 0.8 * wish[part]);
    }
  }
}

// ---- all three fluencies

namespace {

struct Result {
  Status status;
  std::vector<std::uint32_t> count;
  FluencyReport report;
  std::uint32_t total = 0;
};

Result diffused_by(Prepared& p, std::uint32_t budget, Fluency fluency) {
  const Rates rates = solve_rates(integrate_density(p.surface), budget, Calibration::corrected);
  const std::uint32_t nodes = static_cast<std::uint32_t>(p.backbones.node.count);
  const ArenaMark mark = p.block.arena.mark();
  LineSamples lines;
  REQUIRE(sample_lines(p.surface, p.backbones, rates.line, budget - nodes, lines, p.block.arena).is_ok());
  Result out;
  out.total = budget - nodes - static_cast<std::uint32_t>(lines.place.count);
  out.count.assign(p.surface.mesh.face_count(), 12345);
  const std::size_t used = p.block.arena.used();
  out.status = diffuse({&p.surface, &p.backbones, &lines, rates.surface, out.total, fluency},
                       {out.count.data(), out.count.size()}, out.report, p.block.arena);
  CHECK(p.block.arena.used() == used);
  p.block.arena.rewind_results(mark);
  return out;
}

shapes::Shape flat(const std::vector<double>& xy, const std::vector<std::uint32_t>& triangles) {
  shapes::Shape shape;
  for (std::size_t i = 0; i < xy.size(); i += 2) shape.positions.insert(shape.positions.end(), {xy[i], xy[i + 1], 0});
  shape.triangles = triangles;
  return shape;
}

}  // namespace

TEST_CASE("diffuse: every fluency gives the exact sum, from fewer samples than faces to many a face") {
  for (const std::string name : {"sphere", "saddle", "cube"}) {
    Prepared p(name, 1500);
    p.features(name == "cube" ? 30 : 0).chain();
    for (const Fluency fluency : {Fluency::tree, Fluency::region, Fluency::strip}) {
      for (std::uint32_t budget = 150; budget < 300000; budget += 1 + budget / 7) {
        CAPTURE(name);
        CAPTURE(budget);
        const Result result = diffused_by(p, budget, fluency);
        REQUIRE(result.status.is_ok());
        REQUIRE(sum_of(result.count) == result.total);
        for (std::uint32_t c : result.count) REQUIRE(c <= result.total);
        CHECK(result.report.fluency == fluency);
        CHECK(result.report.face_count == p.surface.mesh.face_count());
        if (name == "sphere" && fluency == Fluency::strip) CHECK(result.report.left_over == 0);
        CHECK(result.report.left_over <= 0);
        CHECK(result.report.left_over == std::floor(result.report.left_over));
        if (fluency == Fluency::strip && name == "sphere") CHECK(result.report.largest_received <= 0.5);
        if (fluency != Fluency::strip) CHECK(result.report.split_faces == 0);
        if (fluency == Fluency::region || name != "saddle") CHECK(result.report.teleports == 0);
      }
    }
  }
}

TEST_CASE("diffuse: on a strip no triangle of a surface without lines is a whole sample off its wish") {
  Prepared p("sphere", 5000);
  p.features().chain();
  for (const std::uint32_t budget : {700U, 5000U, 40000U}) {
    const Result result = diffused_by(p, budget, Fluency::strip);
    const DensityIntegrals integrals = integrate_density(p.surface);
    std::size_t off = 0, halves_off = 0;
    for (FaceId f : Ids<FaceId>(result.count.size())) {
      const double wish = budget * face_density(p.surface, f) / integrals.surface;
      off += absolute(result.count[f.value] - wish) > 1.001;
      halves_off += absolute(result.count[f.value] - wish) > 2.001;
    }
    CHECK(off <= result.report.split_faces);  // the halves of one are a sample off each
    CHECK(halves_off == 0);
  }
}

TEST_CASE("diffuse: the smallest meshes, with every fluency") {
  shapes::Shape tetrahedron;
  tetrahedron.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  tetrahedron.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  for (const shapes::Shape& shape :
       {tetrahedron, flat({0, 0, 1, 0, 0, 1}, {0, 1, 2}), flat({0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 2, 0, 2, 3})}) {
    Prepared p(shape);
    p.features().chain();
    for (const Fluency fluency : {Fluency::automatic, Fluency::tree, Fluency::region, Fluency::strip}) {
      for (std::uint32_t budget = 4; budget < 60; ++budget) {
        const Result result = diffused_by(p, budget, fluency);
        REQUIRE(result.status.is_ok());
        REQUIRE(sum_of(result.count) == result.total);
      }
    }
  }
}

TEST_CASE("diffuse: a forced fluency that the surface does not admit is refused, never replaced") {
  Prepared torus("torus", 500);
  torus.features().chain();
  CHECK(diffused_by(torus, 300, Fluency::region).status == Status::not_admitted);
  CHECK(diffused_by(torus, 300, Fluency::strip).status.is_ok());
  Prepared spheres("spheres500", 10000);
  spheres.features().chain();
  CHECK(diffused_by(spheres, 9000, Fluency::region).status == Status::not_admitted);
  const Result strips = diffused_by(spheres, 9000, Fluency::strip);
  CHECK(sum_of(strips.count) == 9000);
  CHECK(strips.report.teleports <= 499);
  CHECK(strips.report.teleports > 300);
  Prepared tube("cylinder_open", 500);
  tube.features().chain();
  CHECK(diffused_by(tube, 300, Fluency::region).status == Status::not_admitted);
  CHECK(diffused_by(tube, 300, Fluency::strip).status == Status::not_admitted);
  CHECK(diffused_by(tube, 300, Fluency::automatic).report.fluency == Fluency::tree);
}

TEST_CASE("diffuse: the automatic fluency is the tree, count by count") {
  Prepared p("sphere", 2000);
  p.features().chain();
  CHECK(diffused_by(p, 700, Fluency::automatic).count == diffused_by(p, 700, Fluency::tree).count);
  CHECK(diffused_by(p, 700, Fluency::automatic).count == diffused(p, 700).count);
  CHECK(diffused_by(p, 700, Fluency::strip).count != diffused_by(p, 700, Fluency::tree).count);
}

TEST_CASE("diffuse: an arena too small at every size, with every fluency") {
  Prepared p("saddle", 60);
  p.features().chain();
  LineSamples lines;
  REQUIRE(sample_lines(p.surface, p.backbones, 10, 300, lines, p.block.arena).is_ok());
  std::vector<std::uint32_t> count(p.surface.mesh.face_count());
  for (const Fluency fluency : {Fluency::tree, Fluency::region, Fluency::strip}) {
    bool done = false;
    for (std::size_t bytes = 0; !done; bytes += 16) {
      REQUIRE(bytes < 100 * count.size() + 2000);
      support::Block block(bytes);
      FluencyReport report;
      const Status status = diffuse({&p.surface, &p.backbones, &lines, 100, 200, fluency}, {count.data(), count.size()},
                                    report, block.arena);
      done = status.is_ok();
      if (!done) REQUIRE(status == Status::out_of_memory);
      REQUIRE(block.arena.used() == 0);
    }
    CHECK(sum_of(count) == 200);
  }
}

TEST_CASE("diffuse: sliced, the stage keeps its scratch between steps and gives it back at the end") {
  Prepared p("sphere", 40000);
  p.features().chain();
  const LineSamples none{{p.backbones.start.data, 1}, {}};
  for (const Fluency fluency : {Fluency::tree, Fluency::region, Fluency::strip}) {
    std::vector<std::uint32_t> count(p.surface.mesh.face_count());
    const std::size_t used = p.block.arena.used();
    Diffuse stage;
    REQUIRE(
        stage.begin({&p.surface, &p.backbones, &none, 1, 5000, fluency}, {count.data(), count.size()}, p.block.arena)
            .is_ok());
    std::size_t steps = 0;
    double share = 0;
    for (; !stage.done(); ++steps) {
      CHECK(stage.share_done() >= share);
      share = stage.share_done();
      REQUIRE(stage.step(p.block.arena).is_ok());
      // Another's results may come and go between two steps.
      const ArenaMark mark = p.block.arena.mark();
      Span<std::uint64_t> other;
      REQUIRE(p.block.arena.result(1000, other).is_ok());
      for (std::uint64_t& x : other) x = steps;
      p.block.arena.rewind_results(mark);
    }
    CHECK(stage.finish(p.block.arena).fluency == fluency);
    CHECK(p.block.arena.used() == used);
    CHECK(sum_of(count) == 5000);
    CHECK(steps > 6 * count.size() / elements_a_piece);
  }
}
