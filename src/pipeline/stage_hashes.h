// What a stage's result is hashed by: where two machines differ, the first stage whose hashes differ is where to look.
#pragma once

#include "isolod/remesh.h"

namespace isolod {
inline namespace v1 {

std::uint64_t hash_repaired(const Remesher::State& s);
std::uint64_t hash_surface(const Remesher::State& s);
std::uint64_t hash_lines(const Remesher::State& s);
std::uint64_t hash_density(const Remesher::State& s);
std::uint64_t hash_rates(const Remesher::State& s);
std::uint64_t hash_closed(const Remesher::State& s);
std::uint64_t hash_atlas(const Remesher::State& s);
std::uint64_t hash_line_samples(const Remesher::State& s);
std::uint64_t hash_places(const Remesher::State& s);
std::uint64_t hash_samples(const Remesher::State& s);
std::uint64_t hash_result(const Remesher::State& s);

}  // namespace v1
}  // namespace isolod
