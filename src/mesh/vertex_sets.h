// Disjoint sets of vertices over one array of parents; the least member stands for its set.
#pragma once

#include "base/index.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

inline void make_singletons(Span<VertexId> parent) {
  for (VertexId v : Ids<VertexId>(parent.count)) parent[v] = v;
}

/// The least vertex of v's set. Halves the path on the way: O(log n) amortised.
inline VertexId set_of(Span<VertexId> parent, VertexId v) {
  while (parent[v] != v) {
    parent[v] = parent[parent[v]];
    v = parent[v];
  }
  return v;
}

inline void unite(Span<VertexId> parent, VertexId a, VertexId b) {
  const VertexId s = set_of(parent, a), t = set_of(parent, b);
  if (s < t) parent[t] = s;
  if (t < s) parent[s] = t;
}

}  // namespace v1
}  // namespace isolod
