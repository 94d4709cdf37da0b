// isolod cut: takes away the faces beyond a plane, whole faces, none is split.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/mesh_facts.h"

namespace tool {

namespace {

/// The points with a x + b y + c z > d lie beyond.
struct Plane {
  double a, b, c, d;

  double height(const double* p) const { return a * p[0] + b * p[1] + c * p[2] - d; }
};

/// Four numbers with commas between them.
Plane plane_from(const std::string& text) {
  std::array<double, 4> number = {};
  const char* at = text.c_str();
  for (std::size_t i = 0; i < number.size(); ++i) {
    char* end = nullptr;
    number[i] = std::strtod(at, &end);
    const char wanted = i + 1 == number.size() ? '\0' : ',';
    if (end == at || *end != wanted || !std::isfinite(number[i])) {
      fail_usage("option --plane: '" + text + "' is not A,B,C,D");
    }
    at = end + 1;
  }
  if (number[0] == 0 && number[1] == 0 && number[2] == 0) fail_usage("option --plane: A, B and C are all 0");
  return {number[0], number[1], number[2], number[3]};
}

/// The faces of `from` whose centroid does not lie beyond the plane, and the vertices that they use, in their order.
TriangleMesh near_side(const isolod::LoadedMesh& from, const Plane& plane) {
  constexpr std::uint32_t unused = UINT32_MAX;
  TriangleMesh mesh;
  std::vector<std::uint32_t> number(from.vertex_count(), unused);
  const double* const position = from.positions.data;
  for (std::size_t f = 0; f < from.triangle_count(); ++f) {
    const std::uint32_t* const corner = from.triangles.data + 3 * f;
    double height = 0;
    for (std::size_t k = 0; k < 3; ++k) height += plane.height(position + 3 * std::size_t{corner[k]}) / 3;
    if (height > 0) continue;
    mesh.triangles.insert(mesh.triangles.end(), corner, corner + 3);
    for (std::size_t k = 0; k < 3; ++k) number[corner[k]] = 0;
  }
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == unused) continue;
    number[v] = static_cast<std::uint32_t>(mesh.vertex_count());
    mesh.positions.insert(mesh.positions.end(), position + 3 * v, position + 3 * v + 3);
  }
  for (std::uint32_t& v : mesh.triangles) v = number[v];
  return mesh;
}

}  // namespace

const CommandRule& cut_rule() {
  static const CommandRule rule = {
      "cut",
      "IN",
      1,
      "Takes away the triangles whose centroid lies beyond a plane.\n"
      "Triangles stay whole; vertices that none uses any more go; the order of the others stays.",
      {{"--plane", "A,B,C,D", "beyond is where A x + B y + C z > D"},
       {"-o", "OUT", "the file to write"},
       {"--ascii", nullptr, "write PLY or STL as text"},
       hash_rule()}};
  return rule;
}

int command_cut(const Arguments& arguments) {
  const std::string& input = arguments.operand(0);
  const Plane plane = plane_from(arguments.required_text("--plane"));
  const std::string output = arguments.required_text("-o");
  const isolod::WriteOptions format = write_options(output, arguments.has("--ascii"));
  OutputFile file(output);
  const InputMesh whole = read_measurable(input);
  const TriangleMesh mesh = near_side(whole.loaded, plane);
  if (mesh.triangles.empty()) fail_status(input, isolod::Status(isolod::Status::empty_mesh));
  write_mesh_file(file, format, mesh);
  std::printf("%s: %zu vertices, %zu triangles; %zu triangles were taken away\n", output.c_str(), mesh.vertex_count(),
              mesh.triangle_count(), whole.loaded.triangle_count() - mesh.triangle_count());
  if (arguments.has("--hash")) print_hash(mesh, output);
  return exit_ok;
}

}  // namespace tool
