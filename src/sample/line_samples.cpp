#include "sample/line_samples.h"

#include "base/array_bytes.h"
#include "base/sort.h"
#include "base/status.h"
#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The two nodes of an open backbone.
struct Ends {
  std::uint32_t first, last;
};

Ends ends_of(const Surface& surface, const Backbones& backbones, std::size_t b) {
  const Span<const HalfedgeId> edges = backbones.edges(b);
  return {backbones.node_of_vertex[surface.mesh.origin[edges[0u]]],
          backbones.node_of_vertex[surface.mesh.target(edges[edges.count - 1])]};
}

struct Wish {
  double density;         // integral of d_f
  std::uint32_t least;    // intervals
  std::uint32_t granted;  // intervals
  Ends ends;              // UINT32_MAX twice when closed
};

/// Backbones that share both ends would become a doubled edge if two of them had no inner sample.
Status raise_parallel(Span<Wish> wishes, Arena& arena) {
  const ScratchScope scope(arena);
  Span<std::uint32_t> order, buffer;
  ISOLOD_TRY(arena.scratch(wishes.count, order));
  ISOLOD_TRY(arena.scratch(wishes.count, buffer));
  for (std::uint32_t b = 0; b < wishes.count; ++b) order[b] = b;
  const auto lower = [&](std::uint32_t b) {
    const Ends e = wishes[b].ends;
    return e.first < e.last ? e : Ends{e.last, e.first};
  };
  merge_sort(order, buffer, [&](std::uint32_t a, std::uint32_t b) {
    const Ends x = lower(a), y = lower(b);
    return x.first < y.first || (x.first == y.first && x.last < y.last);
  });
  for (std::size_t i = 0; i + 1 < order.count; ++i) {
    const Ends x = lower(order[i]), y = lower(order[i + 1]);
    if (x.first == UINT32_MAX || x.first != y.first || x.last != y.last) continue;
    for (std::size_t k = i; k <= i + 1; ++k) {
      if (wishes[order[k]].least < 2) wishes[order[k]].least = 2;
    }
  }
  return {};
}

std::uint32_t line_degree(const Surface& surface, VertexId v) {
  std::uint32_t degree = 0;
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) { degree += surface.line[h] != line_none; });
  return degree;
}

/// How many intervals a backbone needs at least: a loop three, and a seam that meets no other line two, or its two
/// sides would be the whole rim of a chart.
std::uint32_t least_intervals(const Surface& surface, const Backbones& backbones, std::size_t b, Ends ends) {
  if (ends.first == ends.last) return 3;
  const bool is_alone = !is_feature(surface, backbones, b) && line_degree(surface, backbones.node[ends.first]) == 1 &&
                        line_degree(surface, backbones.node[ends.last]) == 1;
  return is_alone ? 2 : 1;
}

Status make_wishes(const Surface& surface, const Backbones& backbones, Span<Wish>& wishes, Arena& arena) {
  ISOLOD_TRY(arena.scratch(backbones.count(), wishes));
  for (std::size_t b = 0; b < wishes.count; ++b) {
    double density = 0;
    for (HalfedgeId h : backbones.edges(b)) density += edge_density(surface, h);
    const bool closed = is_closed(surface, backbones, b);
    const Ends ends = closed ? Ends{UINT32_MAX, UINT32_MAX} : ends_of(surface, backbones, b);
    wishes[b] = {density, least_intervals(surface, backbones, b, ends), 0, ends};
  }
  return raise_parallel(wishes, arena);
}

/// Which backbones end at a node: incident[start[n]] to incident[start[n + 1]].
struct NodeLinks {
  Span<std::uint32_t> start, incident;
};

Status link_nodes(Span<const Wish> wishes, std::size_t node_count, NodeLinks& links, Arena& arena) {
  struct Link {
    std::uint32_t node, backbone;
  };
  Span<Link> all, sorted;
  ISOLOD_TRY(arena.scratch(2 * wishes.count, all));
  ISOLOD_TRY(arena.scratch(2 * wishes.count, sorted));
  ISOLOD_TRY(arena.scratch(node_count + 1, links.start));
  ISOLOD_TRY(arena.scratch(2 * wishes.count, links.incident));
  std::size_t count = 0;
  for (std::uint32_t b = 0; b < wishes.count; ++b) {
    if (wishes[b].ends.first == UINT32_MAX) continue;
    all[count++] = {wishes[b].ends.first, b};
    if (wishes[b].ends.last != wishes[b].ends.first) all[count++] = {wishes[b].ends.last, b};
  }
  counting_sort<Link>(all.first(count), sorted, links.start, [](const Link& l) { return l.node; });
  for (std::size_t i = 0; i < count; ++i) links.incident[i] = sorted[i].backbone;
  return {};
}

/// The flow of the rounding error over the skeleton.
class SkeletonDiffusion {
 public:
  Status begin(Span<Wish> wishes, const NodeLinks& links, Arena& arena) {
    wishes_ = wishes;
    links_ = links;
    ISOLOD_TRY(arena.scratch(wishes.count, error_));
    ISOLOD_TRY(arena.scratch(wishes.count, processed_));
    return {};
  }

  /// Grants intervals to all backbones at this rate; returns how many samples that is, nodes not counted.
  std::uint64_t run(double rate) {
    for (std::size_t b = 0; b < wishes_.count; ++b) error_[b] = 0, processed_[b] = 0;
    std::uint64_t samples = 0;
    FixedCount teleported = 0;
    for (std::uint32_t seed = 0; seed < wishes_.count; ++seed) {
      std::uint32_t b = seed;
      while (b != UINT32_MAX && !processed_[b]) {
        error_[b] += teleported;
        teleported = grant(b, rate);
        samples += wishes_[b].granted - (wishes_[b].ends.first == UINT32_MAX ? 0u : 1u);
        b = pass_on(b, teleported);
      }
    }
    return samples;
  }

 private:
  FixedCount grant(std::uint32_t b, double rate) {
    processed_[b] = 1;
    const FixedCount wish = to_fixed(smaller(rate * wishes_[b].density, 1e9)) + error_[b];
    const std::int32_t rounded = round_count(wish), least = static_cast<std::int32_t>(wishes_[b].least);
    wishes_[b].granted = static_cast<std::uint32_t>(rounded < least ? least : rounded);
    return wish - FixedCount{wishes_[b].granted} * one_sample;
  }

  /// Shares the error among the open ways on at the end of `b` and returns the first of them, or none: then it stays to
  /// be teleported.
  std::uint32_t pass_on(std::uint32_t b, FixedCount& error) {
    const std::uint32_t node = wishes_[b].ends.last;
    if (node == UINT32_MAX) return UINT32_MAX;
    std::uint32_t open = 0, first = UINT32_MAX;
    for (std::uint32_t i = links_.start[node]; i < links_.start[node + 1]; ++i) {
      if (processed_[links_.incident[i]]) continue;
      if (open++ == 0) first = links_.incident[i];
    }
    if (open == 0) return UINT32_MAX;
    const FixedCount share = error / FixedCount{open};
    for (std::uint32_t i = links_.start[node]; i < links_.start[node + 1]; ++i) {
      const std::uint32_t other = links_.incident[i];
      if (processed_[other]) continue;
      error_[other] += share;
      error -= share;
    }
    return first;
  }

  Span<Wish> wishes_;
  NodeLinks links_;
  Span<FixedCount> error_;
  Span<std::uint8_t> processed_;
};

}  // namespace

void spread_on_backbone(const Surface& surface, const Backbones& backbones, std::size_t b, Span<LinePlace> places) {
  const bool closed = is_closed(surface, backbones, b);
  double density = 0, passed = 0;
  for (HalfedgeId h : backbones.edges(b)) density += edge_density(surface, h);
  const double step = density / static_cast<double>(places.count + (closed ? 0 : 1));
  const double phase = closed ? 0.5 : 1;
  std::size_t placed = 0;
  const std::uint32_t first = backbones.start[b], last = backbones.start[b + 1] - 1;
  for (std::uint32_t e = first; e <= last; ++e) {
    const double here = edge_density(surface, backbones.edge[e]);
    while (placed < places.count) {
      const double wanted = (static_cast<double>(placed) + phase) * step;
      if (wanted > passed + here && e != last) break;
      const double along = (wanted - passed) / here;
      places[placed++] = {e, smaller(1, greater(0, along))};
    }
    passed += here;
  }
}

std::size_t sample_lines_bytes(const LineSizes& lines) {
  const std::size_t backbones = lines.backbones;
  const std::size_t links = 2 * array_bytes<std::uint64_t>(2 * backbones) +
                            array_bytes<std::uint32_t>(lines.nodes + 1) + array_bytes<std::uint32_t>(2 * backbones);
  const std::size_t parallel = 2 * array_bytes<std::uint32_t>(backbones);
  const std::size_t flow = array_bytes<FixedCount>(backbones) + array_bytes<std::uint8_t>(backbones);
  return array_bytes<std::uint32_t>(backbones + 1) + array_bytes<LinePlace>(lines.samples) +
         array_bytes<Wish>(backbones) + most_of(parallel, links + flow);
}

Status sample_lines(const Surface& surface, const Backbones& backbones, double line_rate, std::uint32_t room,
                    LineSamples& samples, Arena& arena) {
  ISOLOD_TRY(arena.result(backbones.count() + 1, samples.start));
  const ScratchScope scope(arena);
  Span<Wish> wishes;
  NodeLinks links;
  SkeletonDiffusion diffusion;
  ISOLOD_TRY(make_wishes(surface, backbones, wishes, arena));
  ISOLOD_TRY(link_nodes(wishes, backbones.node.count, links, arena));
  ISOLOD_TRY(diffusion.begin(wishes, links, arena));
  std::uint64_t total = diffusion.run(line_rate);
  if (total > room) {
    const std::uint64_t least = diffusion.run(0);
    if (least > room) return fail(Status::budget_too_small, Element::count, least);
    double low = 0, high = line_rate;
    for (int round = 0; round < 40; ++round) {
      const double middle = 0.5 * (low + high);
      (diffusion.run(middle) > room ? high : low) = middle;
    }
    total = diffusion.run(low);
  }
  ISOLOD_TRY(arena.result(static_cast<std::size_t>(total), samples.place));
  std::uint32_t filled = 0;
  for (std::size_t b = 0; b < wishes.count; ++b) {
    const std::uint32_t count = wishes[b].granted - (wishes[b].ends.first == UINT32_MAX ? 0u : 1u);
    samples.start[b] = filled;
    spread_on_backbone(surface, backbones, b, samples.place.slice(filled, count));
    filled += count;
  }
  samples.start[wishes.count] = filled;
  return {};
}

}  // namespace v1
}  // namespace isolod
