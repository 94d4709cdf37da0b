// The feature skeleton: which edges are lines that the result must keep, and which of their vertices stay put.
//
// Paper, section 2. An edge is a feature when it has one face, when its faces' normals differ by more than the feature
// angle, when the caller tagged it, or when its faces have two materials. A vertex is a corner when the number of its
// feature edges is neither 0 nor 2 (an end, 1, is a dart) or when the line through it turns by more than the corner
// angle.
#pragma once

#include "base/sweep.h"
#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

struct FeatureOptions {
  double feature_angle = 0;  ///< degrees; 0: no sharp edges
  double corner_angle = 30;  ///< degrees
};

/// Whether a vertex is a corner of the skeleton, going by `surface.line` as it is. O(valence).
bool is_corner(const Surface& surface, VertexId v, double corner_angle);

/// A stage: begin, step until done. Fills `surface.line` and `surface.corner`, allocated as results: 1 byte a halfedge,
/// 1 a vertex. O(n) time; with tagged edges 8 bytes a vertex of scratch.
class FindFeatures {
 public:
  Status begin(Surface& surface, const FeatureOptions& options, Arena& arena);
  /// A range of halfedges or vertices, or all tags. Fails with index_out_of_range on a tagged edge that names no
  /// vertex; a tag between vertices that share no edge after repair is passed over.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return phase_ == Phase::done; }

 private:
  enum class Phase : std::uint8_t { geometry, materials, tags, corners, done };

  FeatureOptions options_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
};

/// The whole stage at once.
Status find_features(Surface& surface, const FeatureOptions& options, Arena& arena);

}  // namespace v1
}  // namespace isolod
