// The faces of a file on their way to triangles: measured first, so that the result is allocated exactly, then filled.
#pragma once

#include "base/status.h"
#include "io/polygon.h"

namespace isolod {
inline namespace v1 {

/// What a first pass over the faces counts.
struct FaceCounts {
  std::uint64_t triangles = 0;
  std::uint64_t most_corners = 0;  ///< of one face

  void add_face(std::uint64_t corners) {
    triangles += corners - 2;
    if (corners > most_corners) most_corners = corners;
  }
};

/// No more elements than 32-bit indices can name, nor than can be addressed here.
inline Status check_count(std::uint64_t count) {
  constexpr std::uint64_t addressable = SIZE_MAX / 32;
  constexpr std::uint64_t most = addressable < UINT32_MAX ? addressable : UINT32_MAX - 1;
  return count <= most ? Status() : fail(Status::too_large, Element::count, most);
}

/// Turns the vertices of a triangle strip into triangles of one orientation.
class TriangleStrip {
 public:
  /// True when `vertex` completes a triangle of three different vertices, which is then a b c in this order.
  bool add(std::uint32_t vertex) {
    const bool even = length_ % 2 == 0;
    a = even ? older_ : newer_;
    b = even ? newer_ : older_;
    c = vertex;
    older_ = newer_;
    newer_ = vertex;
    ++length_;
    return length_ > 2 && a != b && b != c && c != a;
  }

  /// The next vertex begins a new strip.
  void restart() { length_ = 0; }

  std::uint32_t a = 0, b = 0, c = 0;

 private:
  std::uint32_t older_ = 0, newer_ = 0;
  std::uint64_t length_ = 0;
};

/// Takes corners one by one and writes a face's triangles when it is closed.
class FaceFiller {
 public:
  /// Room for what was counted: triangles as a result, the corners of one face as scratch.
  Status begin(const FaceCounts& counts, Span<const double> positions, Arena& arena) {
    ISOLOD_TRY(check_count(counts.triangles));
    positions_ = positions;
    ISOLOD_TRY(arena.result(static_cast<std::size_t>(3 * counts.triangles), triangles_));
    return arena.scratch(static_cast<std::size_t>(counts.most_corners), corners_);
  }

  void add_corner(std::uint32_t vertex) {
    ISOLOD_ASSERT(corner_count_ < corners_.count);
    corners_[corner_count_++].vertex = vertex;
  }

  /// A face of at least three corners is complete.
  void close_face() {
    ISOLOD_ASSERT(corner_count_ >= 3 && filled_ + 3 * (corner_count_ - 2) <= triangles_.count);
    triangulate_polygon(positions_.data, corners_.first(corner_count_), triangles_.data + filled_);
    filled_ += 3 * (corner_count_ - 2);
    corner_count_ = 0;
  }

  /// A triangle besides the faces.
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    ISOLOD_ASSERT(filled_ + 3 <= triangles_.count);
    triangles_[filled_] = a;
    triangles_[filled_ + 1] = b;
    triangles_[filled_ + 2] = c;
    filled_ += 3;
  }

  std::size_t triangles_filled() const { return filled_ / 3; }
  Span<std::uint32_t> triangles() const { return triangles_; }

 private:
  Span<const double> positions_;
  Span<std::uint32_t> triangles_;
  Span<PolygonCorner> corners_;
  std::size_t corner_count_ = 0;
  std::size_t filled_ = 0;
};

}  // namespace v1
}  // namespace isolod
