#include "relax/coarse_polish.h"

#include "relax/face_score.h"
#include "sample/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The mean length of the edges at v.
double mean_edge(const Surface& surface, const Halfedges& mesh, const Samples& samples, VertexId v) {
  double sum = 0, count = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    sum += distance(position_of(surface, samples, SampleId{v.value}),
                    position_of(surface, samples, SampleId{mesh.target(h).value}));
    count += 1;
  });
  return sum / count;
}

/// To the best of 26 directions, or nowhere if none is better.
void move_to_best(const Surface& surface, const Halfedges& mesh, Samples& samples, VertexId v, double reach) {
  SurfacePlace& place = samples.place[SampleId{v.value}];
  const SurfacePlace from = place;
  const Vec3 here = position_of(surface, from);
  SurfacePlace best = from;
  double best_score = star_score(surface, mesh, samples, v);
  for (std::int32_t i = 0; i < 27; ++i) {
    const Vec3 way{static_cast<double>(i % 3 - 1), static_cast<double>(i / 3 % 3 - 1), static_cast<double>(i / 9 - 1)};
    place = descend(surface, from.face, here + reach * way);
    const double score = star_score(surface, mesh, samples, v);
    if (!(score > best_score)) continue;
    best_score = score;
    best = place;
  }
  place = best;
}

void flip_to_better(const Surface& surface, Triangulation& mesh, const Samples& samples, VertexId v) {
  constexpr std::uint32_t most_flips = 8;
  for (std::uint32_t flips = 0; flips < most_flips; ++flips) {
    HalfedgeId best = none<HalfedgeId>();
    double best_gain = 0;
    const auto consider = [&](HalfedgeId h) {
      if (!can_flip(mesh, h)) return;
      const FlipScores scores = flip_scores(surface, mesh.mesh, samples, h);
      const double gain = scores.after - scores.before;
      if (gain > best_gain) best = h, best_gain = gain;
    };
    visit_outgoing(mesh.mesh, v, [&](HalfedgeId h) {
      consider(h);
      consider(next(h));
    });
    if (best.is_none()) return;
    flip(mesh, best);
  }
}

}  // namespace

std::uint32_t polish_coarse(const Surface& surface, double wanted_score, Triangulation& mesh, Samples& samples) {
  constexpr std::uint32_t most_rounds = 12;
  std::uint32_t poor = 0;
  for (std::uint32_t round = 0; round < most_rounds; ++round) {
    poor = 0;
    double reach = 1;
    for (std::uint32_t k = 0; k < round % 4; ++k) reach *= 0.5;
    for (VertexId v : Ids<VertexId>(mesh.mesh.vertex_count())) {
      if (star_score(surface, mesh.mesh, samples, v) > wanted_score) continue;
      flip_to_better(surface, mesh, samples, v);
      if (!samples.held[SampleId{v.value}]) {
        move_to_best(surface, mesh.mesh, samples, v, reach * mean_edge(surface, mesh.mesh, samples, v));
      }
      poor += !(star_score(surface, mesh.mesh, samples, v) > wanted_score);
    }
    if (poor == 0) break;
  }
  return poor;
}

}  // namespace v1
}  // namespace isolod
