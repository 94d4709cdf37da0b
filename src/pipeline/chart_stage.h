// The charts of the first mesh, relaxed one by one or side by side, and stitched in their order.
#pragma once

#include "pipeline/state.h"

namespace isolod {
inline namespace v1 {

/// A piece of a chart; with threads as many charts as find room side by side in what is free, 8 at most.
Status step_charts(Remesher::State& state, bool& done, std::uint64_t& units);

}  // namespace v1
}  // namespace isolod
