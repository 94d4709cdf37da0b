// The held samples of a mesh in order along the features that they sit on.
#pragma once

#include "sample/line_samples.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A held sample where it is on the feature skeleton.
struct Rider {
  LinePlace place;
  SampleId sample;
};

struct Riders {
  Span<std::uint32_t> start;  ///< per backbone, one more at the end: its part of `rider`
  Span<Rider> rider;          ///< in order along each backbone; the nodes at its ends are not in it
  Span<SampleId> node;        ///< per node of the backbones: the sample there

  Span<const Rider> on(std::size_t b) const {
    return Span<const Rider>(rider.data + start[b], start[b + 1] - start[b]);
  }
};

/// Finds every held sample on the backbones of the features, seams not among them. Scratch: 4 bytes a backbone, 48 a
/// held sample and 4 a node. O(n log n) time.
Status collect_riders(const Surface& surface, const Backbones& features, const Samples& samples, Riders& riders,
                      Arena& arena);

/// The samples at both ends of an interval of backbone b: interval i lies before rider i. On an open backbone the first
/// and the last are nodes; on a closed one interval 0 begins at the last rider.
struct LineInterval {
  SampleId from, to;
};
LineInterval interval_of(const Surface& surface, const Backbones& features, const Riders& riders, std::size_t b,
                         std::size_t i);

}  // namespace v1
}  // namespace isolod
