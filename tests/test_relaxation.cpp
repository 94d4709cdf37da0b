// Relaxation in overlapping charts, iteration by iteration.
#include "relax/relaxation.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/predicates.h"
#include "isolod/measure.h"
#include "relax/face_score.h"
#include "result/lift.h"
#include "support/checker.h"
#include "support/frames.h"
#include "support/plane_shapes.h"

using namespace isolod;

namespace {

shapes::Shape flat_square() {
  const support::Soup soup = support::square_grid(24, 2);
  shapes::Shape shape;
  for (const Vec3& p : soup.positions) shape.positions.insert(shape.positions.end(), {p.x, p.y, p.z});
  for (const auto& t : soup.triangles) shape.triangles.insert(shape.triangles.end(), t.begin(), t.end());
  return shape;
}

/// A stitched mesh with few iterations behind it, its frames, and a relaxation that has begun.
struct Relaxed : support::Framed {
  explicit Relaxed(shapes::Shape from, std::uint32_t count, double feature_angle = 0, std::vector<double> wish = {})
      : Framed(std::move(from), options_for(count, feature_angle), std::move(wish)) {
    REQUIRE(relaxation.begin(s.surface, frames, mesh(), s.samples, {s.options.weight, 1.8}, block.arena).is_ok());
    REQUIRE(ground.begin(s.surface, frames, block.arena).is_ok());
  }

  static Options options_for(std::uint32_t count, double feature_angle) {
    Options options = support::with_vertices(count, feature_angle);
    options.lloyd_iterations = 0;
    return options;
  }
  shapes::Shape lifted() {
    shapes::Shape result;
    result.positions.resize(3 * s.samples.count());
    lift_samples(s.surface, s.samples, {result.positions.data(), result.positions.size()});
    for (VertexId v : mesh().mesh.origin) result.triangles.push_back(v.value);
    return result;
  }
  double cell_variation() { return measure::quality(checker::surface_of(lifted())).cell_variation; }

  /// Faces that are not positive in the home of any free corner that sees them whole.
  int inverted_at_home() {
    int count = 0;
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) {
      bool seen = false, positive = false;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const SampleId host{mesh().mesh.origin[halfedge(f, k)].value};
        if (s.samples.held[host]) continue;
        ground.select(frames.core_of_face[s.samples.place[host].face]);
        Vec2 uv[3];
        bool whole = true;
        for (std::uint32_t j = 0; j < 3; ++j) {
          const auto place = ground.find(s.samples, SampleId{mesh().mesh.origin[halfedge(f, j)].value});
          whole = whole && !place.is_none();
          if (whole) uv[j] = ground.uv(place);
        }
        seen = seen || whole;
        positive = positive || (whole && orient2d(uv[0], uv[1], uv[2]) > 0);
      }
      count += seen && !positive;
    }
    return count;
  }
  /// Faces that look against `outside` at their centroid.
  template <class Outside>
  int against(Outside outside) {
    int count = 0;
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) {
      const Vec3 a = at(mesh().mesh.origin[halfedge(f, 0)]), b = at(mesh().mesh.origin[halfedge(f, 1)]);
      const Vec3 c = at(mesh().mesh.origin[halfedge(f, 2)]);
      count += !(dot(cross(b - a, c - a), outside((1.0 / 3) * (a + b + c))) > 0);
    }
    return count;
  }
  std::set<std::pair<std::uint32_t, std::uint32_t>> fixed_edges() {
    std::set<std::pair<std::uint32_t, std::uint32_t>> result;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh().mesh.halfedge_count())) {
      const std::uint32_t a = mesh().mesh.origin[h].value, b = mesh().mesh.target(h).value;
      if (mesh().is_fixed(h)) result.insert({std::min(a, b), std::max(a, b)});
    }
    return result;
  }

  Relaxation relaxation;
  FrameGround ground;
};

}  // namespace

TEST_CASE("relaxation: after each iteration a manifold of the same count, its places on the surface") {
  for (const char* name : {"sphere", "torus", "head", "plate3"}) {
    CAPTURE(std::string(name));
    Relaxed r(support::made(name, 2500), 900);
    const std::size_t faces = r.mesh().mesh.face_count();
    const long euler = support::euler(r.mesh());
    for (int i = 0; i < 12; ++i) {
      r.relaxation.iterate();
      REQUIRE(support::broken(r.mesh()) == "");
      CHECK(r.mesh().mesh.face_count() == faces);
      CHECK(r.mesh().mesh.vertex_count() == 900);
      CHECK(support::euler(r.mesh()) == euler);
      for (SampleId s : Ids<SampleId>(900)) {
        const SurfacePlace& p = r.s.samples.place[s];
        if (r.s.samples.held[s]) continue;
        REQUIRE(p.face.value < r.s.surface.mesh.face_count());
        CHECK((p.weight1 >= 0 && p.weight2 >= 0 && p.weight1 + p.weight2 <= 1 + 1e-15));
      }
    }
  }
}

TEST_CASE("relaxation: on a flat square no face is ever turned over") {
  Relaxed r(flat_square(), 800);
  for (int i = 0; i < 15; ++i) {
    const RelaxReport report = r.relaxation.iterate();
    CHECK(report.homeless == 0);
    CHECK(r.inverted_at_home() == 0);
    CHECK(r.against([](Vec3) { return Vec3{0, 0, 1}; }) == 0);
  }
}

TEST_CASE("relaxation: on a sphere no face is ever turned over") {
  Relaxed r(support::made("sphere", 5120), 1500);
  for (int i = 0; i < 15; ++i) {
    const RelaxReport report = r.relaxation.iterate();
    CHECK(report.moved + report.homeless <= 1500);
    CHECK(r.inverted_at_home() == 0);
    CHECK(r.against([](Vec3 p) { return p; }) == 0);
  }
}

TEST_CASE("relaxation: held samples do not move, and edges of features stay") {
  for (const char* name : {"cube", "bracket", "plate"}) {
    CAPTURE(std::string(name));
    Relaxed r(support::made(name, 2000), 900, 30);
    const std::vector<double> before = r.lifted().positions;
    const auto fixed = r.fixed_edges();
    REQUIRE(fixed.size() > 50);
    std::uint32_t moved = 0;
    for (int i = 0; i < 10; ++i) moved += r.relaxation.iterate().moved;
    CHECK(moved > 1000);
    CHECK(r.fixed_edges() == fixed);
    const std::vector<double> after = r.lifted().positions;
    int strayed = 0;
    for (std::size_t s = 0; s < 900; ++s) {
      if (r.s.samples.held[s]) strayed += !std::equal(&before[3 * s], &before[3 * s] + 3, &after[3 * s]);
    }
    CHECK(strayed == 0);
  }
}

TEST_CASE("relaxation: under uniform density the cells become equal") {
  for (const char* name : {"sphere", "torus"}) {
    CAPTURE(std::string(name));
    Relaxed r(support::made(name, 5000), 1200);
    const double first = r.cell_variation();
    for (int i = 0; i < 10; ++i) r.relaxation.iterate();
    const double tenth = r.cell_variation();
    for (int i = 0; i < 30; ++i) r.relaxation.iterate();
    const double last = r.cell_variation();
    CHECK(tenth < 0.5 * first);
    CHECK(last < tenth);
    CHECK(last < 0.065);
  }
}

TEST_CASE("relaxation: a graded density is followed") {
  const shapes::Shape shape = support::made("sphere", 5120);
  std::vector<double> wished;
  for (std::size_t i = 2; i < shape.positions.size(); i += 3) wished.push_back(std::exp(1.2 * shape.positions[i]));
  Relaxed r(shape, 1500, 0, wished);
  for (int i = 0; i < 40; ++i) r.relaxation.iterate();
  const measure::DensityFit fit =
      measure::density_fit(checker::surface_of(shape), wished, checker::surface_of(r.lifted()));
  CHECK(fit.spearman > 0.9);
  CHECK(fit.slope > 0.95);
  CHECK(fit.slope < 1.05);
  CHECK(r.against([](Vec3 p) { return p; }) == 0);
}

TEST_CASE("relaxation: the same twice") {
  const auto print = [] {
    Relaxed r(support::made("head", 2000), 700);
    for (int i = 0; i < 8; ++i) r.relaxation.iterate();
    return checker::hash_of(r.lifted());
  };
  CHECK(print() == print());
}

TEST_CASE("relaxation: with guarded faces none becomes a needle or turns over, however few the samples") {
  for (const char* name : {"torus", "lattice"}) {
    for (const std::uint32_t count : {40U, 90U}) {
      CAPTURE(std::string(name));
      CAPTURE(count);
      support::Framed run(support::made(name, 2000), support::with_vertices(count));
      const auto worst = [&] {
        double score = 1;
        for (VertexId v : Ids<VertexId>(count)) {
          score = std::min(score, star_score(run.s.surface, run.mesh().mesh, run.s.samples, v));
        }
        return score;
      };
      const double before = worst();
      const ScratchScope scope(run.block.arena);
      Relaxation relaxation;
      RelaxOptions options;
      options.guards_faces = true;
      REQUIRE(relaxation.begin(run.s.surface, run.frames, run.mesh(), run.s.samples, options, run.block.arena).is_ok());
      for (int i = 0; i < 15; ++i) {
        relaxation.iterate();
        CHECK(worst() >= std::min(before, fair_score));
      }
      CHECK(support::broken(run.mesh()) == "");
    }
  }
}
