#include "sample/place.h"

#include "base/sobol.h"

namespace isolod {
inline namespace v1 {

namespace {

/// Weights of the corners 1 and 2.
struct Weights {
  double w1, w2;
};

Weights turk(Vec2 square) {
  const double root = square_root(square.y);
  return {(1 - square.x) * root, square.x * root};
}

constexpr std::uint32_t place_rows = 4;
constexpr std::uint32_t piece_count = place_rows * place_rows;

/// Corner weights of piece `p` of the triangle cut into 4 by 4: row by row, upright pieces at even places of a row.
void piece_corners(std::uint32_t p, Weights (&corner)[3]) {
  std::uint32_t row = 0, first = 0;
  while (p >= first + 2 * row + 1) first += 2 * row + 1, ++row;
  const std::uint32_t place = p - first;
  const std::uint32_t column = place / 2;
  const double across = column, down = row;
  const auto at = [](double r, double a) { return Weights{(r - a) / place_rows, a / place_rows}; };
  if (place % 2 == 0) {
    corner[0] = at(down, across), corner[1] = at(down + 1, across), corner[2] = at(down + 1, across + 1);
  } else {
    corner[0] = at(down + 1, across + 1), corner[1] = at(down, across + 1), corner[2] = at(down, across);
  }
}

Weights blend(const Weights (&corner)[3], Weights at) {
  const double w0 = 1 - at.w1 - at.w2;
  return {w0 * corner[0].w1 + at.w1 * corner[1].w1 + at.w2 * corner[2].w1,
          w0 * corner[0].w2 + at.w1 * corner[1].w2 + at.w2 * corner[2].w2};
}

struct PieceDensities {
  double running[piece_count];  // sums up to and with each piece
};

PieceDensities sum_pieces(const double (&density)[3]) {
  PieceDensities sums;
  double sum = 0;
  for (std::uint32_t p = 0; p < piece_count; ++p) {
    Weights corner[3];
    piece_corners(p, corner);
    for (const Weights& w : corner) sum += (1 - w.w1 - w.w2) * density[0] + w.w1 * density[1] + w.w2 * density[2];
    sums.running[p] = sum;
  }
  return sums;
}

Weights varying_place(const PieceDensities& sums, std::uint32_t k, std::uint32_t count) {
  const double wanted = (k + 0.5) / count * sums.running[piece_count - 1];
  std::uint32_t p = 0;
  while (p + 1 < piece_count && sums.running[p] < wanted) ++p;
  Weights corner[3];
  piece_corners(p, corner);
  return blend(corner, turk(sobol_point(k + 1)));
}

}  // namespace

void place_samples(const Surface& surface, const FaceGroups& groups, Span<const std::uint32_t> face_count,
                   Span<std::uint32_t> start, Span<SurfacePlace> places) {
  std::uint32_t filled = 0;
  const std::size_t group_count = groups.start.count - 1;
  for (std::size_t group = 0; group < group_count; ++group) {
    start[group] = filled;
    for (std::size_t i = groups.start[group]; i < groups.start[group + 1]; ++i) {
      const FaceId f = groups.face[i];
      const double density[3] = {surface.density(halfedge(f, 0)), surface.density(halfedge(f, 1)),
                                 surface.density(halfedge(f, 2))};
      const bool varies = density[0] != density[1] || density[0] != density[2];
      PieceDensities sums;
      if (varies && face_count[f] > 0) sums = sum_pieces(density);
      for (std::uint32_t k = 0; k < face_count[f]; ++k) {
        const Weights w = varies ? varying_place(sums, k, face_count[f]) : turk(sobol_point(k + 1));
        places[filled++] = {f, w.w1, w.w2};
      }
    }
  }
  start[group_count] = filled;
}

}  // namespace v1
}  // namespace isolod
