#include "paper/patches.h"

#include <algorithm>
#include <deque>

namespace paper {

using isolod::FaceId;
using isolod::HalfedgeId;
using isolod::Halfedges;
using isolod::Ids;

namespace {

/// Calls call(g) for each triangle beside f.
template <class Call>
void visit_neighbours(const Halfedges& mesh, FaceId f, Call call) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId twin = mesh.twin[halfedge(f, k)];
    if (!twin.is_none()) call(face(twin));
  }
}

class Tiling {
 public:
  Tiling(const Halfedges& mesh, const std::vector<double>& face_weight) : mesh_(mesh), face_weight_(face_weight) {
    taken_.assign(mesh.face_count(), 0);
  }

  /// A triangle of no patch yet, beside one where there is such a one; none when all are used up.
  FaceId next_seed() {
    for (; !beside_.empty(); beside_.pop_front()) {
      if (taken_[beside_.front().value] == 0) return beside_.front();
    }
    for (; next_.value < taken_.size(); ++next_.value) {
      if (taken_[next_.value] == 0) return next_;
    }
    return isolod::none<FaceId>();
  }

  /// Takes triangles until they weigh enough. `total` is what they weigh.
  std::vector<FaceId> grow(FaceId seed, double weight, double& total) {
    std::vector<FaceId> patch;
    std::deque<FaceId> front = {seed};
    taken_[seed.value] = 1;
    total = 0;
    while (!front.empty() && total < weight) {
      const FaceId f = front.front();
      front.pop_front();
      patch.push_back(f);
      total += face_weight_[f.value];
      visit_neighbours(mesh_, f, [&](FaceId g) {
        if (taken_[g.value] == 0) front.push_back(g);
        taken_[g.value] = 1;
      });
    }
    for (const FaceId f : front) {
      taken_[f.value] = 0;
      beside_.push_back(f);
    }
    return patch;
  }

 private:
  const Halfedges& mesh_;
  const std::vector<double>& face_weight_;
  std::vector<char> taken_;
  std::deque<FaceId> beside_;
  FaceId next_{0};
};

}  // namespace

std::vector<std::vector<FaceId>> patches_of(const Halfedges& mesh, const std::vector<double>& face_weight,
                                            double weight) {
  Tiling tiling(mesh, face_weight);
  std::vector<std::vector<FaceId>> patches;
  for (FaceId seed = tiling.next_seed(); !seed.is_none(); seed = tiling.next_seed()) {
    double total = 0;
    std::vector<FaceId> patch = tiling.grow(seed, weight, total);
    if (total >= weight) patches.push_back(std::move(patch));
  }
  return patches;
}

std::size_t most_loops_of_component(const Halfedges& mesh) {
  std::vector<std::uint32_t> component(mesh.face_count(), UINT32_MAX);
  std::uint32_t count = 0;
  for (FaceId seed : Ids<FaceId>(mesh.face_count())) {
    if (component[seed.value] != UINT32_MAX) continue;
    std::deque<FaceId> front = {seed};
    component[seed.value] = count;
    for (; !front.empty(); front.pop_front()) {
      visit_neighbours(mesh, front.front(), [&](FaceId g) {
        if (component[g.value] == UINT32_MAX) front.push_back(g);
        component[g.value] = count;
      });
    }
    ++count;
  }
  std::vector<std::size_t> loops(count, 0);
  std::vector<char> seen(mesh.halfedge_count(), 0);
  for (HalfedgeId start : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!mesh.is_boundary(start) || seen[start.value] != 0) continue;
    ++loops[component[face(start).value]];
    for (HalfedgeId h = start; seen[h.value] == 0;) {
      seen[h.value] = 1;
      for (h = next(h); !mesh.is_boundary(h);) h = next(mesh.twin[h]);
    }
  }
  return loops.empty() ? 0 : *std::max_element(loops.begin(), loops.end());
}

}  // namespace paper
