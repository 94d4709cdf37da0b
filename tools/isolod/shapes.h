// Test shapes made from nothing but a name and a size: the same bytes on every machine.
//
// All of them are oriented manifolds with the outside in front, without degenerate triangles, and of the topology that
// their ShapeInfo states. Only + - * / and the square root are used, and an own sine and cosine (shapes_build.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace shapes {

struct Shape {
  std::vector<double> positions;         ///< x y z of each vertex
  std::vector<std::uint32_t> triangles;  ///< three vertex indices each, counterclockwise from outside
};

struct ShapeInfo {
  std::string name;
  std::string description;
  int genus = 0;  ///< summed over the components
  int loops = 0;  ///< boundary loops; 0: closed
  int components = 1;
};

/// What `make` knows by name. Of the families `plateN` (N holes) and `latticeN` (genus N) it lists a few members.
std::vector<ShapeInfo> list();

/// The entry of one name, also of family members that are not listed. False: there is no such shape.
bool find(const std::string& name, ShapeInfo& info);

/// Makes a shape of about that many triangles, never fewer than its form needs. False: there is no such shape.
bool make(const std::string& name, std::size_t triangles_about, Shape& shape);

}  // namespace shapes
