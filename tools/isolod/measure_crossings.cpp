// Pairs of triangles that pass through each other: every edge of the one against the other, by signs of volumes.
//
// A volume counts as zero where rounding could have made its sign, so that triangles of one plane, and triangles that
// only touch, do not cross.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

/// The sign of the volume of a b c d, or 0 where rounding may have decided it.
int volume_sign(Vector a, Vector b, Vector c, Vector d) {
  const Vector u = b - a, v = c - a, w = d - a;
  const double terms[6] = {u.x * v.y * w.z, u.y * v.z * w.x, u.z * v.x * w.y,
                           u.x * v.z * w.y, u.y * v.x * w.z, u.z * v.y * w.x};
  double sum = 0, size = 0;
  for (int i = 0; i < 6; ++i) {
    sum += i < 3 ? terms[i] : -terms[i];
    size += std::fabs(terms[i]);
  }
  if (std::fabs(sum) <= 4e-15 * size) return 0;
  return sum > 0 ? 1 : -1;
}

bool edge_crosses(Vector p, Vector q, const Corners& c) {
  const int above = volume_sign(c[0], c[1], c[2], p), below = volume_sign(c[0], c[1], c[2], q);
  if (above * below != -1) return false;
  const int side = volume_sign(p, q, c[0], c[1]);
  return side != 0 && volume_sign(p, q, c[1], c[2]) == side && volume_sign(p, q, c[2], c[0]) == side;
}

/// Tries the edges of `mover` against `target`, save those that begin or end in a shared vertex.
bool edges_cross(const Corners& mover, const bool (&shared)[3], const Corners& target) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (!shared[k] && !shared[next] && edge_crosses(mover[k], mover[next], target)) return true;
  }
  return false;
}

void count_pair(const Surface& s, std::size_t i, std::size_t j, Crossings& result) {
  bool of_i[3] = {}, of_j[3] = {};
  int shared = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    for (std::size_t b = 0; b < 3; ++b) {
      if (corner(s, i, a) != corner(s, j, b)) continue;
      of_i[a] = of_j[b] = true;
      ++shared;
    }
  }
  if (shared > 1) return;
  const Corners ci = corners(s, i), cj = corners(s, j);
  if (!edges_cross(ci, of_i, cj) && !edges_cross(cj, of_j, ci)) return;
  ++(shared == 0 ? result.apart : result.at_vertex);
  if (shared == 0) result.pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
}

}  // namespace

Crossings crossings(const Surface& s) {
  Crossings result;
  const BoxTree tree = triangle_tree(s);
  for (std::size_t i = 0; i < s.triangle_count; ++i) {
    Box box;
    for (Vector p : corners(s, i)) box.include(p);
    tree.overlapping(box, [&](std::uint32_t j) {
      if (j > i) count_pair(s, i, j, result);
    });
  }
  std::sort(result.pairs.begin(), result.pairs.end());
  return result;
}

}  // namespace measure
