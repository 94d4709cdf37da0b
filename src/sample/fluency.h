// The order in which error flows over triangles, and what every such order has in common: a face keeps the nearest
// whole number of samples that is not negative and passes the rest on, as an integer, so that nothing is lost.
//
// Paper, section 3.3. Here also the spanning tree (section 3.3.3), which any surface admits: the tree of the dual graph
// is processed from its leaves to its root, each face passes its rest to its parent, a root to the next component's.
#pragma once

#include "sample/face_wishes.h"

namespace isolod {
inline namespace v1 {

/// How an error diffusion went. All errors are in samples.
struct FluencyReport {
  Fluency fluency = Fluency::tree;  ///< what was used
  double largest_received = 0;      ///< the greatest error that any triangle was handed by its neighbours in all
  double largest_passed = 0;        ///< the greatest error that any triangle passed on: a half at most, but for debts
  std::uint32_t teleports = 0;      ///< errors other than zero that went to a triangle that is no neighbour
  double left_over = 0;             ///< the last triangle's error: zero, or a whole debt that others then paid
  std::uint32_t split_faces = 0;    ///< triangles that a single strip passes in two halves
  std::uint32_t face_count = 0;

  /// By how much the triangles have become more: 0.02 is two percent.
  double growth() const { return face_count > 0 ? static_cast<double>(split_faces) / face_count : 0; }
};

/// What flows: the wishes in, the counts out, and a record of the errors.
struct ErrorFlow {
  Span<const FixedCount> wish;     ///< per face
  Span<std::uint32_t> face_count;  ///< per face
  FixedCount largest_received = 0, largest_passed = 0;
  std::uint32_t teleports = 0;
  FixedCount left_over = 0;

  /// Rounds what a face has with what it was handed. Returns the rest, to be passed on.
  FixedCount keep_whole(FixedCount wished, FixedCount received, std::uint32_t& count) {
    largest_received = greater_of(largest_received, received);
    const FixedCount have = wished + received;
    const std::int32_t nearest = round_count(have);
    count = nearest > 0 ? static_cast<std::uint32_t>(nearest) : 0;
    const FixedCount rest = have - FixedCount{count} * one_sample;
    largest_passed = greater_of(largest_passed, rest);
    return rest;
  }

  void report(FluencyReport& out) const {
    out.largest_received = to_double(largest_received);
    out.largest_passed = to_double(largest_passed);
    out.teleports = teleports;
    out.left_over = to_double(left_over);
    out.face_count = static_cast<std::uint32_t>(wish.count);
  }

 private:
  static FixedCount greater_of(FixedCount most, FixedCount error) {
    const FixedCount size = error < 0 ? -error : error;
    return size > most ? size : most;
  }
};

/// What the very last face is left with is zero, or a whole debt where it wished for less than it was handed of one.
/// This lets a face pay what it can of it.
inline void pay_debt(std::int32_t& debt, std::uint32_t& count) {
  const std::uint32_t owed = static_cast<std::uint32_t>(debt), paid = count < owed ? count : owed;
  count -= paid;
  debt -= static_cast<std::int32_t>(paid);
}

/// Error over a spanning tree of the dual graph. The tree is grown depth first, so that it is mostly one long way with
/// short branches: breadth first, every branch would bring its rounding to the root. A stage: begin, step until done.
/// O(n) time, 20 bytes of scratch a face.
class TreeFluency {
 public:
  Status begin(const Halfedges& mesh, const ErrorFlow& flow, Arena& arena);
  void step();
  bool done() const { return pass_ == pass_count; }
  void report(FluencyReport& out) const;
  double share_done() const { return 1.0 * pass_ / std::uint32_t{pass_count}; }
  /// The faces from the roots on, and per face the side towards its parent, none at a root. For tools that draw.
  Span<const FaceId> order() const { return order_; }
  Span<const HalfedgeId> to_parent() const { return to_parent_; }

 private:
  enum Pass : std::uint32_t { clearing, growing, flowing, paying, pass_count };

  void clear();
  void grow();
  void visit(FaceId f, HalfedgeId to_parent);
  void flow();
  void pay();

  Halfedges mesh_;
  ErrorFlow flow_;
  std::uint32_t pass_ = clearing;
  Sweep sweep_;
  Span<FaceId> order_;          ///< from the roots on
  Span<HalfedgeId> to_parent_;  ///< per face: the side towards the parent, none at a root
  Span<FixedCount> received_;
  Span<std::uint8_t> seen_;
  /// Sides by which faces still to visit can be entered. A root adds three, every other face two where it has taken one
  /// off: there are never more than two above the number of faces visited. Nor more than there are edges, which each
  /// add one side, less one taken off for each face visited: three quarters of the faces at most.
  Span<HalfedgeId> stack_;
  std::size_t height_ = 0, visited_ = 0;
  FaceId next_root_{0};
  FixedCount teleported_ = 0;
  std::int32_t debt_ = 0;
};

}  // namespace v1
}  // namespace isolod
