// Error over a growing region of triangles, for a connected surface of genus 0 with at most one boundary.
//
// Paper, section 3.3.1. What is not yet processed stays a disk, a triangulated simple polygon. The next triangle is an
// ear of it (two sides on its rim) where there is one; else one with a single side on the rim and an inner vertex
// opposite. There always is one: of all diagonals of the polygon, inner edges with both ends on the rim, one cuts off a
// least part. A triangle on the rim of that part whose third vertex were on the rim too would have another diagonal as
// a side, or two sides on the rim: an ear. Without diagonals no rim triangle's third vertex is on the rim.
// A disk of two triangles or more is connected through edges, so each triangle but the last has a neighbour that is
// still to be processed, and no error is ever teleported.
// Each step is a collapse, so what is left keeps its homotopy type. It ends in one triangle only where it began as a
// disk: on any other surface no triangle may go at some time, or one is the last of its component. That is how such a
// surface is found out.
#pragma once

#include "sample/fluency.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. The rest of a face goes to its unprocessed neighbours in proportion to the shared
/// edges' lengths. Fails with not_admitted on any other surface. O(n) time: a face enters each of the two queues once
/// at most. Scratch: 21 bytes a face and 1 a vertex.
class RegionFluency {
 public:
  Status begin(const Surface& surface, const ErrorFlow& flow, Arena& arena);
  Status step();
  bool done() const { return pass_ == pass_count; }
  void report(FluencyReport& out) const;
  double share_done() const { return 1.0 * pass_ / std::uint32_t{pass_count}; }
  /// The faces that were processed, in order.
  Span<const FaceId> order() const { return order_; }

 private:
  enum Pass : std::uint32_t { clearing, clearing_vertices, marking, starting, growing, paying, pass_count };

  /// Faces in the order in which they came up; each is taken out once.
  struct Queue {
    Span<FaceId> face;
    std::size_t head = 0, tail = 0;
    void push(FaceId f) { face[tail++] = f; }
    bool empty() const { return head == tail; }
    FaceId pop() { return face[head++]; }
  };

  void mark_boundary(HalfedgeId h);
  void start(FaceId f);
  FaceId next_face();
  bool may_go(FaceId f) const;
  Status grow();
  Status process(FaceId f);
  Status pass_on(FaceId f, FixedCount rest);
  void pay();

  const Surface* surface_ = nullptr;
  ErrorFlow flow_;
  std::uint32_t pass_ = clearing;
  Sweep sweep_;
  Span<FixedCount> received_;
  Span<std::uint8_t> rim_sides_;  ///< per face: its sides on the rim of what is unprocessed; `processed`
  Span<std::uint8_t> on_rim_;     ///< per vertex
  Span<FaceId> order_;
  Queue ears_, front_;
  std::size_t processed_ = 0;
  bool has_boundary_ = false;
  std::int32_t debt_ = 0;
};

}  // namespace v1
}  // namespace isolod
