#include "relax/colours.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

std::size_t Colours::bytes(std::size_t sample_count) {
  return array_bytes<std::uint8_t>(sample_count) + array_bytes<SampleId>(sample_count);
}

Status Colours::begin(std::size_t sample_count, Arena& arena) {
  is_sorted_ = false;
  for (std::uint32_t& n : count_) n = 0;
  ISOLOD_TRY(arena.scratch(sample_count, colour_));
  for (std::uint8_t& c : colour_) c = none;
  return arena.scratch(sample_count, order_);
}

void Colours::colour(const Halfedges& mesh, VertexId v) {
  std::uint32_t taken = 0;
  const auto take = [&](VertexId w) { taken |= colour_[w] == none ? 0 : 1U << colour_[w]; };
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    take(mesh.target(h));
    take(mesh.apex(h));
  });
  std::uint8_t c = 0;
  while (c < last && (taken >> c & 1) != 0) ++c;
  if (colour_[v] != none) --count_[colour_[v]];
  ++count_[c];
  colour_[v] = c;
  is_sorted_ = false;
}

void Colours::mend(const Halfedges& mesh, VertexId v, VertexId w) {
  if (colour_[v] == colour_[w]) colour(mesh, w);
}

bool Colours::sort(Sweep& sweep) {
  if (is_sorted_) return true;
  if (sweep.is_at_start()) {
    std::uint32_t start = 0;
    for (std::uint32_t c = 0; c <= last; ++c) {
      start_[c] = next_[c] = start;
      start += count_[c];
    }
  }
  is_sorted_ = sweep.over<SampleId>(colour_.count, [&](SampleId s) { order_[next_[colour_[s]]++] = s; });
  return is_sorted_;
}

}  // namespace v1
}  // namespace isolod
