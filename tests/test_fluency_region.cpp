#include "sample/fluency_region.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "support/fan.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Grown {
  Status status;
  std::vector<FaceId> order;
  std::vector<std::uint32_t> count;
  FluencyReport report;
};

Grown grow(Prepared& p, const std::vector<FixedCount>& wish) {
  Grown out;
  out.count.assign(wish.size(), 12345);
  ErrorFlow flow;
  flow.wish = {wish.data(), wish.size()};
  flow.face_count = {out.count.data(), out.count.size()};
  RegionFluency stage;
  const ScratchScope scope(p.block.arena);
  out.status = stage.begin(p.surface, flow, p.block.arena);
  while (out.status.is_ok() && !stage.done()) out.status = stage.step();
  if (!out.status.is_ok()) return out;
  out.order.assign(stage.order().begin(), stage.order().end());
  stage.report(out.report);
  return out;
}

/// Random wishes about `mean`, whose sum is whole.
std::vector<FixedCount> random_wishes(std::size_t faces, double mean, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<FixedCount> wish(faces);
  FixedCount sum = 0;
  for (FixedCount& w : wish) {
    w = to_fixed(mean * 2 * static_cast<double>(random() % 1000) / 1000);
    sum += w;
  }
  const FixedCount over = sum & (one_sample - 1);
  wish[0] += over == 0 ? 0 : one_sample - over;
  return wish;
}

std::int64_t sum_of(const std::vector<FixedCount>& wish) {
  FixedCount sum = 0;
  for (FixedCount w : wish) sum += w;
  CHECK(sum % one_sample == 0);
  return sum / one_sample;
}

std::int64_t sum_of(const std::vector<std::uint32_t>& count) {
  std::int64_t sum = 0;
  for (std::uint32_t c : count) sum += c;
  return sum;
}

/// The part of a mesh that is not yet processed, looked at from scratch.
struct Rest {
  const Halfedges& mesh;
  std::vector<char> in;

  bool has(HalfedgeId h) const { return !h.is_none() && in[face(h).value]; }
  int rim_sides(FaceId f) const {
    int sides = 0;
    for (std::uint32_t k = 0; k < 3; ++k) sides += !has(mesh.twin[halfedge(f, k)]);
    return sides;
  }
  std::size_t size() const { return static_cast<std::size_t>(std::count(in.begin(), in.end(), 1)); }

  bool is_connected() const {
    std::vector<FaceId> stack;
    std::vector<char> seen(in.size(), 0);
    for (std::uint32_t f = 0; f < in.size() && stack.empty(); ++f) {
      if (in[f]) stack.push_back({f}), seen[f] = 1;
    }
    std::size_t reached = stack.size();
    while (!stack.empty()) {
      const FaceId f = stack.back();
      stack.pop_back();
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId t = mesh.twin[halfedge(f, k)];
        if (!has(t) || seen[face(t).value]) continue;
        seen[face(t).value] = 1;
        ++reached;
        stack.push_back(face(t));
      }
    }
    return reached == size();
  }

  /// Connected, of Euler characteristic 1, and at each vertex one fan with two rim sides, or a whole star.
  bool is_disk() const {
    std::map<std::uint32_t, int> rim_ends;
    std::set<std::uint32_t> vertices;
    int edges = 0;
    for (std::uint32_t f = 0; f < in.size(); ++f) {
      if (!in[f]) continue;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId h = halfedge(FaceId{f}, k), t = mesh.twin[h];
        vertices.insert(mesh.origin[h].value);
        edges += !has(t) || h < t;
        if (has(t)) continue;
        ++rim_ends[mesh.origin[h].value];
        ++rim_ends[mesh.target(h).value];
      }
    }
    for (const auto& [vertex, ends] : rim_ends) {
      if (ends != 2) return false;
    }
    return is_connected() && static_cast<int>(vertices.size()) - edges + static_cast<int>(size()) == 1;
  }
};

/// What is left must be a disk after every step, and an ear must have gone wherever there was one.
void check_order(const Prepared& p, const Grown& grown) {
  Rest rest{p.surface.mesh, std::vector<char>(p.surface.mesh.face_count(), 1)};
  REQUIRE(grown.order.size() == rest.in.size());
  bool was_disk = rest.is_disk();
  for (FaceId f : grown.order) {
    REQUIRE(rest.in[f.value]);
    bool has_ear = false;
    for (FaceId g : Ids<FaceId>(rest.in.size())) has_ear = has_ear || (rest.in[g.value] && rest.rim_sides(g) >= 2);
    if (has_ear) REQUIRE(rest.rim_sides(f) >= 2);
    if (was_disk) REQUIRE(rest.rim_sides(f) >= 1);
    rest.in[f.value] = 0;
    if (rest.size() == 0) break;
    was_disk = rest.is_disk();
    REQUIRE(was_disk);
  }
}

/// Section 3.3 in the order that was found, in doubles.
std::vector<std::uint32_t> naive_counts(const Prepared& p, const std::vector<FaceId>& order,
                                        const std::vector<FixedCount>& wish) {
  std::vector<double> have;
  for (FixedCount w : wish) have.push_back(to_double(w));
  std::vector<std::uint32_t> count(wish.size());
  std::vector<char> done(wish.size(), 0);
  for (FaceId f : order) {
    done[f.value] = 1;
    const double nearest = std::floor(have[f.value] + 0.5);
    count[f.value] = nearest > 0 ? static_cast<std::uint32_t>(nearest) : 0;
    const double error = have[f.value] - count[f.value];
    double edges = 0;
    for (int pass = 0; pass < 2; ++pass) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId h = halfedge(f, k), t = p.surface.mesh.twin[h];
        if (t.is_none() || done[face(t).value]) continue;
        if (pass == 0) edges += edge_length(p.surface, h);
        if (pass == 1) have[face(t).value] += error * edge_length(p.surface, h) / edges;
      }
    }
  }
  return count;
}

/// A grid whose vertices are shaken; its diagonals and the faces' numbers are random.
shapes::Shape shaken_disk(std::uint32_t width, std::uint32_t height, unsigned seed) {
  std::mt19937 random(seed);
  shapes::Shape shape;
  const auto shake = [&] { return 0.6 * (static_cast<double>(random() % 1000) / 1000 - 0.5); };
  for (std::uint32_t y = 0; y <= height; ++y) {
    for (std::uint32_t x = 0; x <= width; ++x)
      shape.positions.insert(shape.positions.end(), {x + shake(), y + shake(), 0});
  }
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::uint32_t a = y * (width + 1) + x, b = a + 1, c = b + width + 1, d = c - 1;
      if (random() % 2) {
        faces.push_back({a, b, c}), faces.push_back({a, c, d});
      } else {
        faces.push_back({a, b, d}), faces.push_back({b, c, d});
      }
    }
  }
  for (std::size_t i = faces.size(); i > 1; --i) std::swap(faces[i - 1], faces[random() % i]);
  for (const auto& f : faces) shape.triangles.insert(shape.triangles.end(), f.begin(), f.end());
  return shape;
}

shapes::Shape shaken_disk(std::uint32_t size, unsigned seed) { return shaken_disk(size, size, seed); }

shapes::Shape together(const shapes::Shape& a, const shapes::Shape& b) {
  shapes::Shape both = a;
  for (std::size_t i = 0; i < b.positions.size(); ++i) both.positions.push_back(b.positions[i] + (i % 3 == 0 ? 10 : 0));
  for (std::uint32_t v : b.triangles) both.triangles.push_back(v + static_cast<std::uint32_t>(a.positions.size() / 3));
  return both;
}

}  // namespace

TEST_CASE("region: what is left is a disk after every step, and ears go first") {
  std::vector<shapes::Shape> all = {support::made("sphere", 20),      support::made("sphere", 320),
                                    support::made("saddle", 200),     support::made("cube", 300),
                                    support::fan(support::circle(3)), support::fan(support::circle(20))};
  for (unsigned seed = 0; seed < 25; ++seed) all.push_back(shaken_disk(1 + seed % 9, seed));
  // Narrow ones: fronts meet early, and between them lie faces whose third vertex is on the rim.
  for (unsigned seed = 0; seed < 40; ++seed) all.push_back(shaken_disk(12, 1 + seed % 4, seed));
  for (const shapes::Shape& shape : all) {
    Prepared p(shape);
    const std::vector<FixedCount> wish = random_wishes(p.surface.mesh.face_count(), 0.7, 1);
    const Grown grown = grow(p, wish);
    REQUIRE(grown.status.is_ok());
    check_order(p, grown);
    CHECK(sum_of(grown.count) == sum_of(wish));
    CHECK(grown.report.left_over <= 0);
    CHECK(grown.report.left_over == std::floor(grown.report.left_over));
    CHECK(grown.report.teleports == 0);
  }
}

TEST_CASE("region: error goes to unprocessed neighbours in proportion to the edges") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Prepared p(seed % 2 ? shaken_disk(8, seed) : support::made("sphere", 320));
    const std::vector<FixedCount> wish = random_wishes(p.surface.mesh.face_count(), 0.3 * (1 + seed), seed);
    const Grown grown = grow(p, wish);
    REQUIRE(grown.status.is_ok());
    CHECK(grown.count == naive_counts(p, grown.order, wish));
    CHECK(sum_of(grown.count) == sum_of(wish));
  }
}

TEST_CASE("region: the sum is exact with wishes below zero, and no count is") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    Prepared p(shaken_disk(2, seed));
    std::vector<FixedCount> wish = random_wishes(8, 0.4, seed);
    wish[seed % 8] -= 3 * one_sample;  // also the last face's, in some
    wish[(seed / 8) % 8] += 4 * one_sample;
    const Grown grown = grow(p, wish);
    REQUIRE(grown.status.is_ok());
    REQUIRE(sum_of(grown.count) == sum_of(wish));
    CHECK(grown.report.left_over <= 0);
    CHECK(grown.report.left_over == std::floor(grown.report.left_over));
    for (std::uint32_t c : grown.count) REQUIRE(c < 100);
  }
}

TEST_CASE("region: only a connected surface of genus 0 with at most one boundary admits it") {
  const shapes::Shape sphere = support::made("sphere", 80), torus = support::made("torus", 200);
  const std::vector<shapes::Shape> refused = {torus,
                                              support::made("cylinder_open", 200),
                                              support::made("plate3", 300),
                                              together(sphere, sphere),
                                              together(sphere, torus),
                                              together(torus, sphere),
                                              together(sphere, shaken_disk(3, 1)),
                                              together(shaken_disk(3, 1), shaken_disk(3, 2)),
                                              together(torus, shaken_disk(3, 1))};
  for (const shapes::Shape& shape : refused) {
    Prepared p(shape);
    CHECK(grow(p, random_wishes(p.surface.mesh.face_count(), 1, 2)).status == Status::not_admitted);
  }
  Prepared p(sphere);
  CHECK(grow(p, random_wishes(p.surface.mesh.face_count(), 1, 2)).status.is_ok());
}

TEST_CASE("region: an arena too small at every size") {
  Prepared p("sphere", 80);
  const std::vector<FixedCount> wish = random_wishes(p.surface.mesh.face_count(), 1, 3);
  std::vector<std::uint32_t> count(wish.size());
  ErrorFlow flow;
  flow.wish = {wish.data(), wish.size()};
  flow.face_count = {count.data(), count.size()};
  bool done = false;
  for (std::size_t bytes = 0; !done; bytes += 16) {
    REQUIRE(bytes < 21 * wish.size() + p.surface.mesh.vertex_count() + 200);
    support::Block block(bytes);
    RegionFluency stage;
    const Status status = stage.begin(p.surface, flow, block.arena);
    done = status.is_ok();
    if (!done) CHECK(status == Status::out_of_memory);
  }
}
