// Classes of samples of which no two are neighbours: those of one class may move at the same time.
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A greedy colouring of the mesh's vertices, kept up to date under flips. A sample whose neighbours have all the
/// colours joins the last class, whose members may be neighbours and are visited one after the other.
class Colours {
 public:
  /// The scratch of `begin`: 5 bytes a sample.
  static std::size_t bytes(std::size_t sample_count);
  Status begin(std::size_t sample_count, Arena& arena);

  /// Gives v the first colour that none of its neighbours has.
  void colour(const Halfedges& mesh, VertexId v);
  /// After a flip that joined v and w.
  void mend(const Halfedges& mesh, VertexId v, VertexId w);

  /// A piece of the sorting by class, in the order of indices; true at the end.
  bool sort(Sweep& sweep);

  /// Calls visit(id) for all samples, class by class, in pieces as `Sweep::over` does; true at the end.
  template <class Visit>
  bool over(Sweep& sweep, const Parallel& parallel, Visit visit) const {
    if (!parallel.has_threads()) {
      return sweep.over<SampleId>(order_.count, [&](SampleId i) { visit(order_[i]); });
    }
    for (std::uint32_t c = 0; c < last; ++c) {
      const Span<SampleId> members = order_.slice(start_[c], start_[c + 1] - start_[c]);
      sweep.over<SampleId>(parallel, members.count, [&](SampleId i) { visit(members[i]); });
    }
    for (std::size_t i = start_[last]; i < order_.count; ++i) visit(order_[i]);
    return true;
  }

 private:
  static constexpr std::uint8_t last = 15, none = 255;

  bool is_sorted_ = false;
  std::uint32_t count_[last + 1] = {};
  std::uint32_t start_[last + 1] = {};  // of each class in the order
  std::uint32_t next_[last + 1] = {};   // while the order is made
  Span<std::uint8_t> colour_;           // per sample
  Span<SampleId> order_;
};

}  // namespace v1
}  // namespace isolod
