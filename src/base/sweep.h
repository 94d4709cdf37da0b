// A linear pass that stops and goes on, on one thread or on the caller's.
#pragma once

#include "base/index.h"
#include "base/parallel.h"

namespace isolod {
inline namespace v1 {

/// How many elements one piece of work visits. A run that is spread over many calls stops between pieces.
constexpr std::size_t elements_a_piece = 4096;

/// Visits the elements below `count` in order, a piece a call. It starts anew once it has come to the end.
class Sweep {
 public:
  bool is_at_start() const { return next_ == 0; }

  /// Calls visit(id) for the next piece, of so many elements; true when the last one has been visited.
  template <class Id, class Visit>
  bool over(std::size_t count, Visit visit, std::size_t piece = elements_a_piece) {
    const std::size_t end = count - next_ < piece ? count : next_ + piece;
    for (; next_ < end; ++next_) visit(Id{static_cast<std::uint32_t>(next_)});
    if (next_ < count) return false;
    next_ = 0;
    return true;
  }

  /// The same where no visit reads what another one writes: with threads there are all the elements are one piece of
  /// work, spread over them.
  template <class Id, class Visit>
  bool over(const Parallel& parallel, std::size_t count, Visit visit) {
    if (!parallel.has_threads()) return over<Id>(count, visit);
    constexpr std::size_t range = 128;
    parallel.run(static_cast<std::uint32_t>((count + range - 1) / range), [&](std::uint32_t piece) {
      const std::size_t begin = piece * range, end = count - begin < range ? count : begin + range;
      for (std::size_t i = begin; i < end; ++i) visit(Id{static_cast<std::uint32_t>(i)});
    });
    return true;
  }

 private:
  std::size_t next_ = 0;
};

}  // namespace v1
}  // namespace isolod
