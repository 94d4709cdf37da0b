// What the measuring files share: vectors, edges with their triangles, a box tree over triangles or segments.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "measure.h"

namespace measure {

struct Vector {
  double x = 0, y = 0, z = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(Vector a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vector a) { return std::sqrt(dot(a, a)); }
inline double squared(double x) { return x * x; }

constexpr double pi = 3.14159265358979323846;
constexpr std::uint32_t no_index = 0xFFFFFFFFu;

/// The angle between two vectors, in degrees; 0 where one of them is zero.
inline double angle_between(Vector a, Vector b) { return std::atan2(length(cross(a, b)), dot(a, b)) * (180 / pi); }

inline Vector position(const Surface& s, std::uint32_t v) {
  const double* p = s.positions + 3 * std::size_t(v);
  return {p[0], p[1], p[2]};
}

using Corners = std::array<Vector, 3>;

inline std::uint32_t corner(const Surface& s, std::size_t triangle, std::size_t k) {
  return s.triangles[3 * triangle + k % 3];
}
inline Corners corners(const Surface& s, std::size_t t) {
  return {position(s, corner(s, t, 0)), position(s, corner(s, t, 1)), position(s, corner(s, t, 2))};
}
/// Twice the area times the normal.
inline Vector area_normal(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }

/// An edge with the triangles around it, of which there may be any number.
struct Edge {
  std::uint32_t a = 0, b = 0;  // a < b
  std::size_t first = 0, count = 0;
};

struct EdgeSide {
  std::uint32_t a = 0, b = 0, triangle = 0;
  bool forward = true;  // the triangle runs from a to b
};

/// All edges in order of (a, b), their sides in order of triangles. Triangles that name a vertex twice are left out.
struct EdgeTable {
  std::vector<Edge> edges;
  std::vector<EdgeSide> sides;

  explicit EdgeTable(const Surface& surface);
};

/// Whether each vertex is inner: used, with all its edges between exactly two triangles.
std::vector<char> inner_vertices(const Surface& surface, const EdgeTable& table);

/// The Voronoi area of each corner of a triangle; where it is obtuse, halves and quarters of the whole.
std::array<double, 3> corner_areas(const Corners& c);

/// What of the surface is nearer to a vertex than to any other of its triangles.
struct Cell {
  double area = 0;
  double mass = 0;   ///< the integral of the density
  double share = 0;  ///< the vertex's total angle over 2 pi
};

/// Each triangle is cut by the perpendicular bisectors of its edges, exactly also where it is obtuse, and each of its
/// corners gets its part. The density is asked for at the parts' corners and centroids.
std::vector<Cell> clipped_cells(const Surface& surface, const std::function<double(Vector)>& density);

double mean_edge_length(const Surface& surface);

struct Box {
  Vector low = {1e300, 1e300, 1e300}, high = {-1e300, -1e300, -1e300};

  void include(Vector p);
  bool meets(const Box& other) const;
  double squared_distance(Vector p) const;
};

struct Near {
  std::uint32_t index = no_index;  // of the primitive
  double squared_distance = std::numeric_limits<double>::infinity();
  Vector point;
};

/// A binary tree of boxes over triangles. A segment is a triangle whose last two corners are one.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Corners> primitives);

  /// The nearest primitive; among equals the lowest index found. `hint` is any primitive to begin with.
  Near nearest(Vector p, std::uint32_t hint = no_index) const;
  /// Calls for every primitive whose box meets this one.
  void overlapping(const Box& box, const std::function<void(std::uint32_t)>& call) const;
  const std::vector<Corners>& primitives() const { return primitives_; }

 private:
  struct Node {
    Box box;
    std::uint32_t left = 0, right = 0;   // an inner node's children
    std::uint32_t first = 0, count = 0;  // a leaf's primitives in order_; count 0: an inner node
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  void try_leaf(const Node& node, Vector p, Near& best) const;

  std::vector<Corners> primitives_;
  std::vector<Vector> centres_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

BoxTree triangle_tree(const Surface& surface);
Vector closest_on_segment(Vector p, Vector a, Vector b);
Vector closest_on_triangle(Vector p, const Corners& c);

/// Calls call(0) ... call(pieces - 1), each once, on some threads.
void in_parallel(int threads, int pieces, const std::function<void(int)>& call);

struct Spread {
  double mean = 0, deviation = 0, variation = 0;  // variation: the standard deviation over the mean
};
Spread spread(const std::vector<double>& values);

}  // namespace measure
