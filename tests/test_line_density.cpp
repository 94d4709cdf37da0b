// d_f from d_s, and d_f as the caller gave it.
#include "surface/line_density.h"

#include <cmath>

#include "support/holes.h"

using namespace isolod;
using support::Prepared;

namespace {

/// A bracket with another d_s at every corner of every face.
struct Uneven : Prepared {
  Uneven() : Prepared("plate3", 600) {
    features(30);
    for (std::size_t h = 0; h < surface.mesh.halfedge_count(); ++h)
      wedge.push_back(1 + static_cast<float>(h * 37 % 101));
    surface.wedge_density = {wedge.data(), wedge.size()};
  }
  double at(HalfedgeId h) const { return static_cast<double>(wedge[h.value]); }
  std::vector<float> wedge;
};

}  // namespace

TEST_CASE("line_density: the root of the mean of the sides, at both ends, the same from either side") {
  Uneven p;
  const Surface& s = p.surface;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const HalfedgeId t = s.mesh.twin[h];
    const double near = t.is_none() ? p.at(h) : (p.at(h) + p.at(next(t))) / 2;
    const double far = t.is_none() ? p.at(next(h)) : (p.at(next(h)) + p.at(t)) / 2;
    CHECK(line_density(s, h) == doctest::Approx(std::sqrt(near)).epsilon(1e-14));
    CHECK(line_density_at_end(s, h) == doctest::Approx(std::sqrt(far)).epsilon(1e-14));
    CHECK(edge_density(s, h) ==
          doctest::Approx(edge_length(s, h) * (std::sqrt(near) + std::sqrt(far)) / 2).epsilon(1e-14));
    if (t.is_none()) continue;
    CHECK(line_density(s, t) == line_density_at_end(s, h));
    CHECK(edge_density(s, t) == edge_density(s, h));
  }
}

TEST_CASE("line_density: a given number goes before d_s, edge by edge; without one d_s counts") {
  Uneven p;
  Surface& s = p.surface;
  std::vector<float> given(p.wedge.size(), 0);
  std::vector<double> otherwise;
  for (HalfedgeId h : Ids<HalfedgeId>(given.size())) otherwise.push_back(edge_density(s, h));
  for (HalfedgeId h : Ids<HalfedgeId>(given.size())) {
    const HalfedgeId t = s.mesh.twin[h];
    const std::uint32_t lower = t.is_none() || h < t ? h.value : t.value;
    given[h.value] = lower % 3 == 0 ? static_cast<float>(0.5 + lower % 7) : 0;
  }
  s.given_line_density = {given.data(), given.size()};
  int with = 0, open = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(given.size())) {
    const double d = static_cast<double>(given[h.value]);
    with += d > 0;
    open += d > 0 && s.mesh.is_boundary(h);
    if (d > 0) CHECK(line_density(s, h) == d);
    if (d > 0) CHECK(line_density_at_end(s, h) == d);
    CHECK(edge_density(s, h) == doctest::Approx(d > 0 ? d * edge_length(s, h) : otherwise[h.value]).epsilon(1e-14));
  }
  CHECK(with > 100);
  CHECK(open > 5);
}
