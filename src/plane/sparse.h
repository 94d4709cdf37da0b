// A symmetric sparse matrix in compressed rows, and its product with a field of plane vectors.
#pragma once

#include "base/vector.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// Row i holds entries start[i] to start[i + 1]; the diagonal is kept apart.
struct SparseMatrix {
  Span<std::uint32_t> start;
  Span<std::uint32_t> column;
  Span<double> value;
  Span<double> diagonal;

  std::size_t row_count() const { return diagonal.count; }

  Vec2 row_times(std::size_t row, Span<const Vec2> x) const {
    Vec2 sum = diagonal[row] * x[row];
    for (std::uint32_t k = start[row]; k < start[row + 1]; ++k) sum = sum + value[k] * x[column[k]];
    return sum;
  }
};

}  // namespace v1
}  // namespace isolod
