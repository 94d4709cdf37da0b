// The list of shapes and the way from a name to its maker.
#include "shapes.h"

#include "shapes_build.h"

namespace shapes {

namespace {

using Maker = void (*)(std::size_t, Shape&);

struct Entry {
  ShapeInfo info;
  Maker make;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> table = {
      {{"sphere", "the unit sphere", 0, 0, 1}, make_sphere},
      {{"torus", "a torus of radii 1 and 0.4", 1, 0, 1}, make_torus},
      {{"knot", "a smooth tube along a trefoil", 1, 0, 1}, make_knot},
      {{"head", "a smooth bumpy blob like a head", 0, 0, 1}, make_head},
      {{"bracket", "a CAD part: sharp edges, five through holes, a rounded fillet", 5, 0, 1}, make_bracket},
      {{"tetrahedron", "a regular tetrahedron", 0, 0, 1}, make_tetrahedron},
      {{"cube", "a cube of side 2", 0, 0, 1}, make_cube},
      {{"cylinder_open", "a tube without ends", 0, 2, 1}, make_cylinder},
      {{"disk", "a flat disk", 0, 1, 1}, make_disk},
      {{"saddle", "a saddle over a square", 0, 1, 1}, make_saddle},
      {{"spheres500", "500 small spheres in one file", 0, 0, 500}, make_spheres},
      {{"tube200", "a closed tube 200 times as long as thick", 0, 0, 1}, make_tube200},
  };
  return table;
}

ShapeInfo plate_info(const std::string& name, int holes) {
  return {name, "a flat plate with " + std::to_string(holes) + " round holes", 0, holes + 1, 1};
}

ShapeInfo lattice_info(const std::string& name, int genus) {
  return {name, "smooth struts of genus " + std::to_string(genus), genus, 0, 1};
}

/// The number behind a family's name; `bare` where there is none, -1 where the name is another one.
int family_number(const std::string& name, const std::string& family, int bare) {
  if (name.compare(0, family.size(), family) != 0) return -1;
  if (name.size() == family.size()) return bare;
  if (name.size() > family.size() + 4) return -1;
  int number = 0;
  for (std::size_t i = family.size(); i < name.size(); ++i) {
    if (name[i] < '0' || name[i] > '9') return -1;
    number = 10 * number + (name[i] - '0');
  }
  return number;
}

constexpr int plate_holes = 24, lattice_genus = 5;

}  // namespace

std::vector<ShapeInfo> list() {
  std::vector<ShapeInfo> all;
  for (const Entry& entry : entries()) all.push_back(entry.info);
  for (const char* name : {"plate", "plate400", "lattice", "lattice10", "lattice50", "lattice150"}) {
    ShapeInfo info;
    if (find(name, info)) all.push_back(info);
  }
  return all;
}

bool find(const std::string& name, ShapeInfo& info) {
  for (const Entry& entry : entries()) {
    if (entry.info.name != name) continue;
    info = entry.info;
    return true;
  }
  const int holes = family_number(name, "plate", plate_holes), genus = family_number(name, "lattice", lattice_genus);
  if (holes >= 1) info = plate_info(name, holes);
  if (genus >= 1) info = lattice_info(name, genus);
  return holes >= 1 || genus >= 1;
}

bool make(const std::string& name, std::size_t triangles_about, Shape& shape) {
  for (const Entry& entry : entries()) {
    if (entry.info.name != name) continue;
    entry.make(triangles_about, shape);
    return true;
  }
  const int holes = family_number(name, "plate", plate_holes), genus = family_number(name, "lattice", lattice_genus);
  if (holes >= 1) make_plate(holes, triangles_about, shape);
  if (genus >= 1) make_lattice(genus, triangles_about, shape);
  return holes >= 1 || genus >= 1;
}

}  // namespace shapes
