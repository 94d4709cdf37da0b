#include "atlas/chart.h"
#include "sample/place.h"

#include <algorithm>
#include <cmath>

#include "support/stages.h"

using namespace isolod;

namespace {

/// Triangles side by side, one chart a few faces, and densities by corner.
struct Field {
  explicit Field(std::uint32_t faces, std::uint32_t charts = 1)
      : density(3 * faces, 1.0f), chart(faces), order(faces), number(faces), count(faces, 0) {
    for (std::uint32_t c = 0; c <= charts; ++c) chart_start.push_back(c * faces / charts);
    for (std::uint32_t f = 0; f < faces; ++f) order[f] = FaceId{faces - 1 - f};
    atlas.faces = {order.data(), order.size()};
    atlas.start = {chart_start.data(), chart_start.size()};
    atlas.chart_of_face = {chart.data(), chart.size()};
    atlas.place = {number.data(), number.size()};
    surface.wedge_density = {density.data(), density.size()};
  }

  std::vector<SurfacePlace> run() {
    std::uint32_t sum = 0;
    for (std::uint32_t c : count) sum += c;
    std::vector<SurfacePlace> places(sum);
    start.assign(chart_start.size(), 77);
    place_samples(surface, {atlas.faces, atlas.start}, {count.data(), count.size()}, {start.data(), start.size()},
                  {places.data(), places.size()});
    return places;
  }

  std::vector<float> density;
  std::vector<std::uint32_t> chart, chart_start;
  std::vector<FaceId> order;
  std::vector<std::uint32_t> number, count, start;
  Atlas atlas;
  Surface surface;
};

/// Which of the 16 similar parts a place is in, row by row.
int part_of(const SurfacePlace& p) {
  const double w0 = 1 - p.weight1 - p.weight2;
  const int a = std::min(3, int(4 * w0)), b = std::min(3, int(4 * p.weight1)), c = std::min(3, int(4 * p.weight2));
  return 16 * a + 4 * b + c;  // 10 with sum 3, 6 with sum 2
}

std::vector<int> parts() {
  std::vector<int> all;
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      for (int c = 0; c < 4; ++c) {
        if (a + b + c == 3 || a + b + c == 2) all.push_back(16 * a + 4 * b + c);
      }
    }
  }
  return all;
}

/// The share of the density that lies in a part: that at its middle, for a linear density.
double share(const float (&d)[3], int part) {
  const int a = part / 16, b = part / 4 % 4, c = part % 4;
  const double shift = a + b + c == 3 ? 1.0 / 3 : 2.0 / 3;
  return ((a + shift) * double(d[0]) + (b + shift) * double(d[1]) + (c + shift) * double(d[2])) / 4 /
         (16 * (double(d[0]) + double(d[1]) + double(d[2])) / 3);
}

}  // namespace

TEST_CASE("place: all weights are strictly inside") {
  Field field(3);
  field.count = {4096, 1, 4096};
  for (int k = 0; k < 3; ++k) field.density[std::size_t(k)] = k == 1 ? 1e-12f : 1.0f;
  for (const SurfacePlace& p : field.run()) {
    REQUIRE(p.weight1 > 0);
    REQUIRE(p.weight2 > 0);
    REQUIRE(p.weight1 + p.weight2 < 1);
  }
}

TEST_CASE("place: uniform samples fill a triangle more evenly than chance, at any number") {
  REQUIRE(parts().size() == 16);
  for (const std::uint32_t n : {16U, 64U, 100U, 777U, 4096U, 20000U}) {
    CAPTURE(n);
    Field field(1);
    field.count[0] = n;
    double chi = 0;
    const std::vector<SurfacePlace> places = field.run();
    for (const int part : parts()) {
      const double got = double(
          std::count_if(places.begin(), places.end(), [&](const SurfacePlace& p) { return part_of(p) == part; }));
      chi += (got - n / 16.0) * (got - n / 16.0) / (n / 16.0);
    }
    CHECK(chi < 12);  // 15 is expected of random points
  }
}

TEST_CASE("place: no two samples of a face are at the same place") {
  Field field(1);
  for (const bool varies : {false, true}) {
    field.density[2] = varies ? 5.0f : 1.0f;
    field.count[0] = 2000;
    std::vector<SurfacePlace> places = field.run();
    std::sort(places.begin(), places.end(), [](const SurfacePlace& a, const SurfacePlace& b) {
      return a.weight1 < b.weight1 || (a.weight1 == b.weight1 && a.weight2 < b.weight2);
    });
    for (std::size_t i = 1; i < places.size(); ++i) {
      REQUIRE((places[i].weight1 != places[i - 1].weight1 || places[i].weight2 != places[i - 1].weight2));
    }
  }
}

TEST_CASE("place: a varying density is followed, piece by piece") {
  const float fields[][3] = {{1, 1, 9}, {9, 1, 1}, {0.01f, 4, 2}, {1, 2, 1.001f}, {1e-12f, 1e-12f, 1}};
  for (const auto& d : fields) {
    for (const std::uint32_t n : {10U, 160U, 4000U}) {
      CAPTURE(n);
      CAPTURE(d[0]);
      CAPTURE(d[1]);
      CAPTURE(d[2]);
      Field field(1);
      for (std::size_t k = 0; k < 3; ++k) field.density[k] = d[k];
      field.count[0] = n;
      const std::vector<SurfacePlace> places = field.run();
      for (const int part : parts()) {
        const double got = double(
            std::count_if(places.begin(), places.end(), [&](const SurfacePlace& p) { return part_of(p) == part; }));
        CHECK(absolute(got - n * share(d, part)) <= 1.001);
      }
    }
  }
}

TEST_CASE("place: chart by chart, in the order of the atlas, every face its count") {
  Field field(10, 4);
  for (std::uint32_t f = 0; f < 10; ++f) field.count[f] = f * f % 7;
  const std::vector<SurfacePlace> places = field.run();
  std::size_t i = 0;
  for (std::size_t chart = 0; chart < 4; ++chart) {
    CHECK(field.start[chart] == i);
    for (FaceId f : field.atlas.chart_faces(chart)) {
      for (std::uint32_t k = 0; k < field.count[f.value]; ++k) CHECK(places[i++].face == f);
    }
  }
  CHECK(field.start[4] == i);
  CHECK(i == places.size());
}
