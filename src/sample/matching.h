// A matching with the most edges in a graph whose nodes have at most three edges: the dual of a triangulation.
//
// Edmonds, "Paths, trees, and flowers" (1965), in the form that Gabow, "An efficient implementation of Edmonds'
// algorithm for maximum matching on Graphs" (1976) and Tarjan, "Data Structures and Network Algorithms" (1983) gave it:
// blossoms are sets of a union-find structure, and a node that a blossom turned from odd to even keeps the edge that
// closed it, its bridge, from which its way to the root is read when it is needed.
// The dual of a closed triangulation is cubic, and an edge of it lies on the circle around a vertex, so it has no
// bridge; such a graph has a perfect matching (Petersen, "Die Theorie der regulaeren Graphs", 1891), and one with the
// most edges is perfect.
#pragma once

#include "base/sweep.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. The graph is given by darts: dart d leaves node d / 3, and twin[d] is the same edge
/// from the other side, none where the node has no such edge. `mate` holds, per node, the dart of its matched edge or
/// none; it comes with any matching, which is only ever made greater.
/// One search a node that is still alone: O(k n log n) time for n nodes and k that are alone at first. A search mostly
/// ends nearby; one that finds the graph exhausted has cost O(n log n). Scratch: 45 bytes a node.
class Matching {
 public:
  Status begin(Span<const HalfedgeId> twin, Span<HalfedgeId> mate, Arena& arena);
  void step();
  bool done() const { return is_cleared_ && !is_searching_ && root_ == mate_.count; }
  /// How many nodes stay alone.
  std::uint32_t alone_count() const { return alone_; }

 private:
  using Node = std::uint32_t;
  static constexpr Node nowhere = UINT32_MAX;
  enum Label : std::uint8_t { unseen, even, odd, turned };  // turned: odd at first, even since a blossom holds it

  /// A part of an alternating way that is still to be written: see `write_way`.
  struct Part {
    enum Kind : std::uint32_t { towards, away, pair } kind;
    Node from, to;
  };

  void clear(Node v);
  void look_from(Node u);
  void reach(Node v, Label label);
  Node mate_of(Node v) const { return twin_[mate_[v]].value / 3; }
  Node base_of(Node v);
  Node common_base(Node a, Node b);
  void absorb(Node from, Node base, Node side, Node beyond);
  void augment(Node alone, Node from);
  void write_way(Part part);
  void match(Node a, Node b);
  void end_search();

  Span<const HalfedgeId> twin_;
  Span<HalfedgeId> mate_;
  Span<std::uint8_t> label_;
  Span<Node> before_;           ///< of an odd node: the even one it was reached from
  Span<Node> side_, beyond_;    ///< of a turned node: its bridge, `side_` on its own side
  Span<Node> set_;              ///< union-find; the root of a set is the blossom's base
  Span<std::uint32_t> met_;     ///< when a search for a common base last came by
  Span<Node> reached_, queue_;  ///< nodes with a label; even ones to look from
  Span<Node> way_;              ///< an augmenting path
  Span<Part> parts_;            ///< of it, still to be written
  std::size_t reached_count_ = 0, head_ = 0, tail_ = 0, way_count_ = 0;
  std::uint32_t time_ = 0, root_ = 0, alone_ = 0;
  bool is_cleared_ = false, is_searching_ = false;
  Sweep sweep_;
};

}  // namespace v1
}  // namespace isolod
