// The held samples of a mesh in order along the features that they sit on.
#pragma once

#include "sample/samples.h"
#include "sample/track.h"

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

/// The scratch of `collect_riders`.
std::size_t riders_bytes(const LineSizes& lines);

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

/// How many intervals the riders of one backbone make.
inline std::size_t interval_count(const Track& track, Span<const Rider> on) {
  return track.closed ? on.count : on.count + 1;
}

/// From where to where interval i goes, in density along the track of its backbone. Interval 0 of a closed one begins
/// before the track does, below 0.
struct MassRange {
  double from, to;
};
MassRange mass_of_interval(const Track& track, Span<const Rider> on, std::size_t i);

/// Where so much density lies behind the beginning of the track; less than 0 counts back from its end.
LineAnchor anchor_at_mass(const Backbones& features, const Track& track, double mass);

}  // namespace v1
}  // namespace isolod
