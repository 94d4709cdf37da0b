// The charts of the first mesh: each laid flat, its samples triangulated and relaxed there, and lifted (paper, sections
// 4.4 and 5).
#pragma once

#include "pipeline/state.h"

namespace isolod {
inline namespace v1 {

/// A chart; with threads as many as find room side by side in what is free, 8 at most.
Status step_charts(Remesher::State& state, bool& done, std::uint64_t& units);

}  // namespace v1
}  // namespace isolod
