// Pairs of triangles that pass through each other: every edge of the one against the other, by signs of volumes.
//
// The signs are exact. In doubles alone, triangles of one oblique plane, however far from each other, seem to cross
// once in some thousand pairs: all their volumes are rounding, with any signs. Where rounding may have decided a sign,
// the volume is summed without any: Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
// predicates", 1997, theorem 10 (grow expansion), over the 24 products of three coordinates.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

/// A sum of doubles that overlap in no bit, the smallest first: its last one has the sign of the whole.
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = x + parts_[i], of_part = sum - x;
      const double lost = (x - (sum - of_part)) + (parts_[i] - of_part);
      if (lost != 0) parts_[kept++] = lost;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    count_ = kept;
  }
  void add_product(double a, double b, double c) {
    const double high = a * b, low = std::fma(a, b, -high);
    for (double part : {high, low}) {
      const double product = part * c;
      add(std::fma(part, c, -product));
      add(product);
    }
  }
  int sign() const { return count_ == 0 ? 0 : parts_[count_ - 1] > 0 ? 1 : -1; }

 private:
  double parts_[96];  // 24 products of four doubles each
  std::size_t count_ = 0;
};

/// The determinant of p q r.
void add_determinant(ExactSum& sum, Vector p, Vector q, Vector r) {
  sum.add_product(p.x, q.y, r.z);
  sum.add_product(p.y, q.z, r.x);
  sum.add_product(p.z, q.x, r.y);
  sum.add_product(-p.x, q.z, r.y);
  sum.add_product(-p.y, q.x, r.z);
  sum.add_product(-p.z, q.y, r.x);
}

int exact_volume_sign(Vector a, Vector b, Vector c, Vector d) {
  ExactSum sum;
  add_determinant(sum, b, c, d);
  add_determinant(sum, a, d, c);
  add_determinant(sum, a, b, d);
  add_determinant(sum, a, c, b);
  return sum.sign();
}

/// The sign of the volume of a b c d.
int volume_sign(Vector a, Vector b, Vector c, Vector d) {
  const Vector u = b - a, v = c - a, w = d - a;
  const double terms[6] = {u.x * v.y * w.z, u.y * v.z * w.x, u.z * v.x * w.y,
                           u.x * v.z * w.y, u.y * v.x * w.z, u.z * v.y * w.x};
  double sum = 0, size = 0;
  for (int i = 0; i < 6; ++i) {
    sum += i < 3 ? terms[i] : -terms[i];
    size += std::fabs(terms[i]);
  }
  if (std::fabs(sum) <= 4e-15 * size) return exact_volume_sign(a, b, c, d);
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
