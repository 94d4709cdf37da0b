// A grid of struts of exactly the wished genus: the surface of voxels, smoothed.
//
// The struts are a graph of cycle rank g: a spanning tree of a box of nodes and g of its other edges. The surface
// of a thick connected graph has that genus. Struts meet face to face, so the voxels' surface is a manifold.
#include <numeric>
#include <utility>

#include "shapes_build.h"

namespace shapes {

namespace {

struct Box {
  int size[3] = {2, 2, 2};

  int nodes() const { return size[0] * size[1] * size[2]; }
  int rank() const { return 2 * nodes() - size[0] * size[1] - size[1] * size[2] - size[2] * size[0] + 1; }
};

struct Strut {
  int cell[3];  // the lower node
  int axis;
};

/// The box of fewest nodes that has enough cycles; the flattest one goes last.
Box box_for(int genus) {
  Box best;
  for (int limit = 3; best.rank() < genus; ++limit) {
    best.size[0] = best.size[1] = best.size[2] = limit;
  }
  const int top = best.size[2] + 2;
  for (int a = 2; a <= top; ++a) {
    for (int b = a; b <= top; ++b) {
      for (int c = b; c <= top; ++c) {
        Box box;
        box.size[0] = c;
        box.size[1] = b;
        box.size[2] = a;
        if (box.rank() >= genus && box.nodes() < best.nodes()) best = box;
      }
    }
  }
  return best;
}

int root_of(std::vector<int>& parent, int a) {
  while (parent[std::size_t(a)] != a) a = parent[std::size_t(a)];
  return a;
}

/// A spanning tree of the box's grid and `genus` of its other edges, spread evenly over them.
std::vector<Strut> choose_struts(const Box& box, int genus) {
  std::vector<Strut> tree, other;
  std::vector<int> parent(std::size_t(box.nodes()));
  std::iota(parent.begin(), parent.end(), 0);
  const int stride[3] = {1, box.size[0], box.size[0] * box.size[1]};
  for (int node = 0; node < box.nodes(); ++node) {
    Strut strut = {{node % box.size[0], node / stride[1] % box.size[1], node / stride[2]}, 0};
    for (; strut.axis < 3; ++strut.axis) {
      if (strut.cell[strut.axis] + 1 == box.size[strut.axis]) continue;
      const int a = root_of(parent, node), b = root_of(parent, node + stride[strut.axis]);
      (a == b ? other : tree).push_back(strut);
      if (a != b) parent[std::size_t(b)] = a;
    }
  }
  const long long count = static_cast<long long>(other.size());
  for (long long i = 0; i < count; ++i) {
    if ((i + 1) * genus / count != i * genus / count) tree.push_back(other[std::size_t(i)]);
  }
  return tree;
}

struct Voxels {
  int size[3] = {0, 0, 0};
  std::vector<char> filled;

  bool inside(const int (&p)[3]) const {
    for (int k = 0; k < 3; ++k) {
      if (p[k] < 0 || p[k] >= size[k]) return false;
    }
    return filled[index(p)] != 0;
  }
  std::size_t index(const int (&p)[3]) const {
    return (std::size_t(p[2]) * std::size_t(size[1]) + std::size_t(p[1])) * std::size_t(size[0]) + std::size_t(p[0]);
  }
  void fill(const int (&from)[3], const int (&extent)[3]) {
    int p[3];
    for (p[2] = from[2]; p[2] < from[2] + extent[2]; ++p[2]) {
      for (p[1] = from[1]; p[1] < from[1] + extent[1]; ++p[1]) {
        for (p[0] = from[0]; p[0] < from[0] + extent[0]; ++p[0]) filled[index(p)] = 1;
      }
    }
  }
};

struct Measures {
  int thick = 2, gap = 4;  // voxels across a strut, and between two nodes
};

Measures measures_for(std::size_t triangles, int nodes, int struts) {
  Measures best;
  double least = -1;
  for (int thick = 2; thick < 400; ++thick) {
    for (int gap = (3 * thick + 1) / 2; gap <= 3 * thick; ++gap) {
      const double quads = 4.0 * struts * thick * gap + (6.0 * nodes - 2.0 * struts) * thick * thick;
      const double error = std::fabs(2 * quads - double(triangles));
      if (least >= 0 && error >= least) continue;
      least = error;
      best.thick = thick;
      best.gap = gap;
    }
  }
  return best;
}

Voxels build_voxels(const Box& box, const std::vector<Strut>& struts, const Measures& m) {
  Voxels voxels;
  const int period = m.thick + m.gap;
  for (int k = 0; k < 3; ++k) voxels.size[k] = (box.size[k] - 1) * period + m.thick;
  voxels.filled.assign(std::size_t(voxels.size[0]) * std::size_t(voxels.size[1]) * std::size_t(voxels.size[2]), 0);
  for (const Strut& strut : struts) {  // each strut with its two nodes
    const int from[3] = {strut.cell[0] * period, strut.cell[1] * period, strut.cell[2] * period};
    int extent[3] = {m.thick, m.thick, m.thick};
    extent[strut.axis] += period;
    voxels.fill(from, extent);
  }
  return voxels;
}

using Quads = std::vector<std::array<std::uint32_t, 4>>;

/// The quads between filled and empty, seen from the empty side counterclockwise.
Quads surface_quads(Builder& builder, const Voxels& voxels) {
  Quads quads;
  int p[3];
  for (p[2] = 0; p[2] < voxels.size[2]; ++p[2]) {
    for (p[1] = 0; p[1] < voxels.size[1]; ++p[1]) {
      for (p[0] = 0; p[0] < voxels.size[0]; ++p[0]) {
        if (!voxels.inside(p)) continue;
        for (int face = 0; face < 6; ++face) {
          const int axis = face / 2, up = face % 2;
          int beside[3] = {p[0], p[1], p[2]};
          beside[axis] += 2 * up - 1;
          if (voxels.inside(beside)) continue;
          std::array<std::uint32_t, 4> quad{};
          for (std::size_t c = 0; c < 4; ++c) {
            double at[3] = {double(p[0]), double(p[1]), double(p[2])};
            at[axis] += up;
            at[(axis + 1) % 3] += c == 1 || c == 2 ? 1 : 0;
            at[(axis + 2) % 3] += c >= 2 ? 1 : 0;
            quad[up != 0 ? c : 3 - c] = builder.vertex({at[0], at[1], at[2]});
          }
          quads.push_back(quad);
        }
      }
    }
  }
  return quads;
}

/// Moves every vertex halfway to the mean of its neighbours along the quads' edges, some times.
void smooth(std::vector<double>& positions, const Quads& quads, int times) {
  std::vector<double> sum(positions.size()), count(positions.size() / 3);
  for (int pass = 0; pass < times; ++pass) {
    std::fill(sum.begin(), sum.end(), 0.0);
    std::fill(count.begin(), count.end(), 0.0);
    for (const auto& quad : quads) {
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t a = quad[c], b = quad[(c + 1) % 4];  // the quad beside gives b its neighbour a
        for (std::size_t k = 0; k < 3; ++k) sum[3 * a + k] += positions[3 * b + k];
        count[a] += 1;
      }
    }
    for (std::size_t i = 0; i < positions.size(); ++i) {
      positions[i] += 0.5 * (sum[i] / count[i / 3] - positions[i]);
    }
  }
}

}  // namespace

void make_lattice(int genus, std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const Box box = box_for(genus);
  const std::vector<Strut> struts = choose_struts(box, genus);
  const Measures m = measures_for(triangles, box.nodes(), int(struts.size()));
  const Quads quads = surface_quads(builder, build_voxels(box, struts, m));
  smooth(shape.positions, quads, whole(m.thick * m.thick / 8.0, 2));
  for (double& x : shape.positions) x /= m.thick + m.gap;
  for (std::size_t i = 0; i < quads.size(); ++i) builder.quad(quads[i], i % 2 == 0);
}

}  // namespace shapes
