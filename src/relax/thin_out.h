// Samples taken out where they stand too close, one after the other: the counterpart of `insert_where_sparse`.
//
// The sample whose star carries the least density goes first, merged into the neighbour that leaves the best worst face
// (an edge collapse, after Hoppe, DeRose, Duchamp, McDonald and Stuetzle 1993); edges around are then flipped by their
// angles. A sample that could only go by turning a face against the surface waits until no other can go, and one on a
// line, unless lines are treated alike, longer than that; corners stay. The topology stays the same (`can_collapse`).
// Where no sample at all can go, flips picked by a seeded generator are made until one can, up to a bound.
#pragma once

#include "base/heap.h"
#include "relax/face_score.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

struct ThinOptions {
  std::uint32_t target_count = 0;  ///< samples that are to be left
  bool keep_lines = false;         ///< held samples stay all
  bool lines_alike = false;        ///< held samples go where they are too close, as free ones do, and not last
};

/// A stage: begin, step until done, finish.
class ThinOut {
 public:
  /// Its scratch, `finish` included.
  static std::size_t bytes(std::size_t sample_count, std::size_t face_count);
  /// `surface`, `mesh` and `samples` must stay until `finish`. Scratch: 17 bytes a sample.
  Status begin(const Surface& surface, const ThinOptions& options, Triangulation& mesh, Samples& samples, Arena& arena);
  /// Looks at one sample, or makes one flip where none can go. O(valence^3) time, O(log n) for the queue.
  void step();
  bool done() const;
  /// Closes the gaps: the samples that are left keep their order. If they are more than the target, no more could go.
  /// Scratch: 4 bytes a sample and 4 a face, given back. O(n) time.
  Status finish(Arena& arena);

 private:
  bool is_candidate(VertexId v) const;
  double star_mass(VertexId v) const;
  double line_spacing(VertexId v) const;
  double line_rank(VertexId v) const;
  CollapseChoice best_choice(VertexId v) const;
  void push(VertexId v);
  void push_star(VertexId v);
  void remove(HalfedgeId h);
  bool flip_if_better(HalfedgeId h);
  void flip_around(VertexId v);
  void unlock();

  const Surface* surface_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  ThinOptions options_;
  IndexedHeap heap_;
  Span<std::uint8_t> stays_;  // per sample: a corner, or held where lines are kept
  double rank_ = 0;           // as good as more than any mass
  std::uint32_t left_ = 0;
  std::uint32_t tries_ = 0;  // to unlock, since the last removal
  std::uint64_t random_ = 0;
};

/// The whole stage at once. `samples` tells how many are left.
Status thin_out(const Surface& surface, const ThinOptions& options, Triangulation& mesh, Samples& samples,
                Arena& arena);

}  // namespace v1
}  // namespace isolod
