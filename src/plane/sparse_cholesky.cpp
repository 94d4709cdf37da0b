#include "plane/sparse_cholesky.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t no_parent = UINT32_MAX;
constexpr double least_pivot = 1e-13;  // of the diagonal: less than this is rounding
constexpr double new_pivot = 1e-6;     // of the diagonal

}  // namespace

Status HermitianFactor::begin(const HermitianMatrix& matrix, Arena& arena) {
  matrix_ = &matrix;
  row_ = replaced_ = 0;
  const std::size_t n = matrix.diagonal.count;
  ISOLOD_TRY(arena.scratch(n + 1, start_));
  ISOLOD_TRY(arena.scratch(n, diagonal_));
  ISOLOD_TRY(arena.scratch(n, parent_));
  ISOLOD_TRY(arena.scratch(n, flag_));
  ISOLOD_TRY(arena.scratch(n, reach_));
  ISOLOD_TRY(arena.scratch(n, filled_));
  ISOLOD_TRY(arena.scratch(n, work_));
  std::uint64_t entries = 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    parent_[k] = no_parent;
    flag_[k] = k;
    filled_[k] = 0;
    work_[k] = {0, 0};
    for (std::uint32_t p = matrix.start[k]; p < matrix.start[k + 1]; ++p) {
      for (std::uint32_t i = matrix.row[p]; flag_[i] != k; i = parent_[i]) {
        if (parent_[i] == no_parent) parent_[i] = k;
        ++filled_[i];
        ++entries;
        flag_[i] = k;
      }
    }
  }
  start_[0u] = 0;
  for (std::size_t k = 0; k < n; ++k) {
    start_[k + 1] = start_[k] + filled_[k];
    filled_[k] = 0;
    flag_[k] = no_parent;
  }
  ISOLOD_TRY(arena.scratch(static_cast<std::size_t>(entries), rows_));
  return arena.scratch(static_cast<std::size_t>(entries), values_);
}

/// The columns that reach row k, in an order of elimination, at the end of `reach_`; where they begin. Scatters the
/// column k of the matrix.
std::uint32_t HermitianFactor::find_reach(std::uint32_t k) {
  std::uint32_t top = static_cast<std::uint32_t>(diagonal_.count);
  flag_[k] = k;
  for (std::uint32_t p = matrix_->start[k]; p < matrix_->start[k + 1]; ++p) {
    std::uint32_t i = matrix_->row[p];
    work_[i] = work_[i] + matrix_->value[p];
    std::uint32_t length = 0;
    for (; flag_[i] != k; i = parent_[i]) {
      reach_[length++] = i;
      flag_[i] = k;
    }
    while (length > 0) reach_[--top] = reach_[--length];
  }
  return top;
}

std::uint64_t HermitianFactor::compute_row(std::uint32_t k) {
  std::uint64_t operations = 1;
  double pivot = matrix_->diagonal[k];
  for (std::uint32_t at = find_reach(k); at < diagonal_.count; ++at) {
    const std::uint32_t i = reach_[at];
    const Vec2 y = work_[i];
    work_[i] = {0, 0};
    const std::uint64_t end = start_[i] + filled_[i];
    for (std::uint64_t p = start_[i]; p < end; ++p) {
      Vec2& w = work_[rows_[p]];
      w = w - times(values_[p], y);
    }
    const Vec2 scaled = (1 / diagonal_[i]) * y;
    pivot = pivot - dot(scaled, y);
    rows_[end] = k;
    values_[end] = {scaled.x, -scaled.y};
    operations += ++filled_[i];
  }
  const double whole = matrix_->diagonal[k];
  if (!(pivot > least_pivot * whole)) {
    pivot = whole > 0 ? new_pivot * whole : 1;
    ++replaced_;
  }
  diagonal_[k] = pivot;
  return operations;
}

void HermitianFactor::step(std::uint64_t operations) {
  for (std::uint64_t made = 0; row_ < diagonal_.count && made < operations; ++row_) made += compute_row(row_);
}

void HermitianFactor::solve(Span<Vec2> x) const {
  const std::size_t n = diagonal_.count;
  for (std::size_t j = 0; j < n; ++j) {
    const Vec2 y = x[j];
    for (std::uint64_t p = start_[j]; p < start_[j + 1]; ++p) {
      Vec2& w = x[rows_[p]];
      w = w - times(values_[p], y);
    }
  }
  for (std::size_t j = n; j-- > 0;) {
    Vec2 sum = (1 / diagonal_[j]) * x[j];
    for (std::uint64_t p = start_[j]; p < start_[j + 1]; ++p) sum = sum - conjugate_times(values_[p], x[rows_[p]]);
    x[j] = sum;
  }
}

}  // namespace v1
}  // namespace isolod
