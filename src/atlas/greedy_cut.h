// A short cut graph by cutting one short cycle after another.
//
// Erickson and Har-Peled, "Optimally cutting a surface into a disk" (2004): the shortest cut graph is NP-hard to find;
// cutting along short essential cycles until no handle is left, then joining the rims by a tree of short ways, is
// within O(log^2 g) of it. Here the cycles are non-separating, and what was cut already costs nothing to pass. A cycle
// no longer than twice the shortest is found as they do it: every essential cycle crosses one of the 4 g shortest ways
// that reach the ends of the edges which a tree and a co-tree leave over; each of these ways is drawn together to a
// point, the shortest non-separating loop through that point is found (again by tree and co-tree), and the part of the
// way between its two ends is added. The best cycle is then tried again from a few of its own vertices. The rims are
// joined each time by the shortest way from one of them to the next, which need not be a least tree: the O(log^2 g)
// is not proved for this form.
//
// Holes are shut (edge_metric.h) and need not be joined. What a component of genus g > 0 becomes is what cut_graph.h
// says. A component of genus 0 is left as it is, also a closed one. This is a measured alternative to cut_graph.h,
// which is as short and much faster; its result may be straightened there (`CutStart::given`).
//
// Time O(g^2 n log n); 330 bytes a vertex of scratch, about.
#pragma once

#include "atlas/loop_system.h"

namespace isolod {
inline namespace v1 {

struct GreedyCutOptions {
  std::uint32_t retries = 8;  ///< vertices of each cycle from which it is tried again
  bool join_rims = true;      ///< else each handle leaves two loops: genus 0, a shorter cut, but no disk
};

/// Fills `cut`, given with one byte a halfedge, 1 on both halfedges of an edge that is cut. `length` comes from
/// `measure_edges`. Fails with invalid_result where the count of the result is wrong: a defect of this library.
Status make_greedy_cut(const Surface& surface, Span<const double> length, const GreedyCutOptions& options,
                       Span<std::uint8_t> cut, Arena& arena);

}  // namespace v1
}  // namespace isolod
