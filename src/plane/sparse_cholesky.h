// A direct solver for sparse Hermitian systems: L D L^H with L stored by columns.
//
// Up-looking elimination after Davis, "Algorithm 849: a concise sparse Cholesky factorization package" (2005),
// with complex entries. A plane vector stands for a complex number. The rows of the factor are computed one by one, so
// that the work can stop and go on.
//
// Takes: a Hermitian matrix that is positive definite, or nearly (a pivot that rounding spoiled is replaced, counted,
// and the factor is then a preconditioner). The order of elimination is the caller's: see dissection.h.
// Time: the sum of the squares of the columns' lengths. Scratch: 20 bytes an entry of L and 44 a row; if it does not
// fit, out_of_memory.
#pragma once

#include "base/vector.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// a * b and conj(a) * b, of complex numbers.
inline Vec2 times(Vec2 a, Vec2 b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
inline Vec2 conjugate_times(Vec2 a, Vec2 b) { return {a.x * b.x + a.y * b.y, a.x * b.y - a.y * b.x}; }

/// The part over the diagonal by columns: column k holds the rows start[k] to start[k + 1], all below k, perhaps twice.
struct HermitianMatrix {
  Span<std::uint32_t> start;
  Span<std::uint32_t> row;
  Span<Vec2> value;
  Span<double> diagonal;
};

class HermitianFactor {
 public:
  /// Finds the pattern of the factor. `matrix` must stay where it is until the last row.
  Status begin(const HermitianMatrix& matrix, Arena& arena);
  /// Computes at least one row, and more as long as fewer than `operations` multiplications were made.
  void step(std::uint64_t operations);
  bool done() const { return row_ == diagonal_.count; }
  double share_done() const { return static_cast<double>(row_) / static_cast<double>(diagonal_.count); }

  std::uint64_t entry_count() const { return rows_.count; }
  /// Pivots that were not positive beyond rounding.
  std::uint32_t replaced_pivots() const { return replaced_; }

  /// x becomes the solution for the right side that it held.
  void solve(Span<Vec2> x) const;

 private:
  std::uint64_t compute_row(std::uint32_t k);
  std::uint32_t find_reach(std::uint32_t k);

  const HermitianMatrix* matrix_ = nullptr;
  Span<std::uint64_t> start_;  // per column of L
  Span<std::uint32_t> rows_;   // per entry
  Span<Vec2> values_;          // per entry
  Span<double> diagonal_;
  Span<std::uint32_t> parent_;  // the elimination tree; UINT32_MAX at a root
  Span<std::uint32_t> flag_, reach_;
  Span<std::uint32_t> filled_;  // entries that column has so far
  Span<Vec2> work_;
  std::uint32_t row_ = 0;
  std::uint32_t replaced_ = 0;
};

}  // namespace v1
}  // namespace isolod
