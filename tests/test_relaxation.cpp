// Relaxation star by star, iteration by iteration.
#include "relax/relaxation.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "isolod/measure.h"
#include "relax/face_score.h"
#include "result/feature_lines.h"
#include "result/lift.h"
#include "support/checker.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

shapes::Shape flat_square() {
  const support::Soup soup = support::square_grid(24, 2);
  shapes::Shape shape;
  for (const Vec3& p : soup.positions) shape.positions.insert(shape.positions.end(), {p.x, p.y, p.z});
  for (const auto& t : soup.triangles) shape.triangles.insert(shape.triangles.end(), t.begin(), t.end());
  return shape;
}

/// A stitched mesh with few iterations behind it, and a relaxation that has begun. Samples on features are where the
/// charts put them and stay, or are spread anew and slide.
struct Relaxed : support::Stitched {
  explicit Relaxed(shapes::Shape from, std::uint32_t count, double feature_angle = 0, std::vector<double> wish = {},
                   bool slides = false)
      : Stitched(std::move(from), options_for(count, feature_angle), std::move(wish)) {
    if (slides) {
      REQUIRE(sample_features_anew(s.surface, lines, {s.options.weight, true}, s.samples, block.arena).is_ok());
    }
    RelaxOptions options;
    options.weight = s.options.weight;
    options.line_rate = s.first_rates.line;
    REQUIRE(relaxation.begin(s.surface, features(), mesh(), s.samples, options, block.arena).is_ok());
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

  /// Faces without area, or that look against the surface at one of their corners.
  int turned_over() {
    int count = 0;
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) {
      const Halfedges& h = mesh().mesh;
      const VertexId corners[3] = {h.origin[halfedge(f, 0)], h.origin[halfedge(f, 1)], h.origin[halfedge(f, 2)]};
      count += !(face_score(s.surface, s.samples, corners) > 0);
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
    CHECK(report.bent == 0);
    CHECK(r.turned_over() == 0);
    CHECK(r.against([](Vec3) { return Vec3{0, 0, 1}; }) == 0);
  }
}

TEST_CASE("relaxation: on a sphere no face is ever turned over") {
  Relaxed r(support::made("sphere", 5120), 1500);
  for (int i = 0; i < 15; ++i) {
    const RelaxReport report = r.relaxation.iterate();
    CHECK(report.moved <= 1500);
    CHECK(report.bent == 0);
    CHECK(r.turned_over() == 0);
    CHECK(r.against([](Vec3 p) { return p; }) == 0);
  }
}

TEST_CASE("relaxation: samples that are held in place do not move, and edges of features stay") {
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

TEST_CASE("relaxation: samples on features slide on their own line and pass none, corners and pinned ones stay") {
  for (const char* name : {"cube", "bracket", "plate"}) {
    CAPTURE(std::string(name));
    Relaxed r(support::made(name, 2000), 900, 30, {}, true);
    const auto order = [&] { return support::order_on_lines(r.s.surface, r.lines, r.s.samples, r.block.arena); };
    const std::vector<double> before = r.lifted().positions;
    const std::vector<std::uint8_t> holds(r.s.samples.held.begin(), r.s.samples.held.end());
    const auto fixed = r.fixed_edges();
    const auto first_order = order();
    for (int i = 0; i < 10; ++i) {
      r.relaxation.iterate();
      REQUIRE(support::broken(r.mesh()) == "");
      CHECK(order() == first_order);
    }
    CHECK(r.fixed_edges() == fixed);
    CHECK(std::equal(holds.begin(), holds.end(), r.s.samples.held.begin()));
    const std::vector<double> after = r.lifted().positions;
    int strayed = 0, slid = 0, held = 0;
    for (std::size_t s = 0; s < 900; ++s) {
      const bool stayed = std::equal(&before[3 * s], &before[3 * s] + 3, &after[3 * s]);
      strayed += holds[s] == hold_place && !stayed;
      slid += holds[s] == hold_line && !stayed;
      held += holds[s] == hold_line;
    }
    CHECK(strayed == 0);
    CHECK(slid > held / 2);
    CHECK(held > 50);
  }
}

TEST_CASE("relaxation: sliding leaves no gap in a line") {
  for (const std::uint32_t count : {120U, 1000U}) {
    CAPTURE(count);
    Relaxed r(support::made("cylinder_open", 6000), count, 0, {}, true);
    for (int i = 0; i < 40; ++i) r.relaxation.iterate();
    const Halfedges& mesh = r.mesh().mesh;
    double sum = 0, longest = 0, shortest = 1e300, intervals = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      if (!mesh.is_boundary(h)) continue;
      const double size = distance(r.at(mesh.origin[h]), r.at(mesh.target(h)));
      sum += size;
      longest = std::max(longest, size);
      shortest = std::min(shortest, size);
      intervals += 1;
    }
    CHECK(longest < 1.25 * sum / intervals);
    CHECK(shortest > 0.8 * sum / intervals);
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
  for (const char* name : {"torus", "lattice", "bracket"}) {
    for (const std::uint32_t count : {40U, 90U}) {
      CAPTURE(std::string(name));
      CAPTURE(count);
      const double feature_angle = name == std::string("bracket") ? 40 : 0;
      support::Stitched run(support::made(name, 2000), support::with_vertices(count, feature_angle));
      REQUIRE(sample_features_anew(run.s.surface, run.lines, {}, run.s.samples, run.block.arena).is_ok());
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
      options.line_rate = run.s.first_rates.line;
      REQUIRE(
          relaxation.begin(run.s.surface, run.features(), run.mesh(), run.s.samples, options, run.block.arena).is_ok());
      std::uint32_t moved = 0;
      for (int i = 0; i < 15; ++i) {
        moved += relaxation.iterate().moved;
        CHECK(worst() >= std::min(before, fair_score));
      }
      CHECK(moved > 2 * count);
      CHECK(support::broken(run.mesh()) == "");
    }
  }
}
