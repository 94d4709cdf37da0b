// isolod validate: whether a mesh is an oriented 2-manifold without faults, as it stands in its file.
#include <cstdio>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/mesh_facts.h"
#include "mesh/validate.h"

namespace tool {

namespace {

using isolod::Defect;

/// The defect with the element that has it, in words. Indices are counted from 0.
std::string describe_finding(const isolod::Finding& finding) {
  const std::string number = std::to_string(finding.element);
  const std::string corner = std::to_string(finding.element / 3);  // a halfedge is a corner of a triangle
  switch (finding.defect) {
    case Defect::index_out_of_range:
      return "triangle " + number + ": a corner is no vertex";
    case Defect::degenerate_index:
      return "triangle " + number + ": two corners are the same vertex";
    case Defect::not_finite:
      return "vertex " + number + ": its position is NaN or infinite";
    case Defect::zero_area:
      return "triangle " + number + ": its corners lie on one line";
    case Defect::duplicate_triangle:
      return "triangle " + number + ": an earlier one has the same corners";
    case Defect::nonmanifold_edge:
      return "triangle " + corner + ": one of its edges has more than two triangles";
    case Defect::inconsistent_orientation:
      return "triangle " + corner + ": a neighbour looks to the other side";
    case Defect::nonmanifold_vertex:
      return "vertex " + number + ": its triangles form more than one fan";
    case Defect::unused_vertex:
      return "vertex " + number + ": no triangle uses it";
    default:
      return std::string("element ") + number + ": broken";
  }
}

/// By the library's own check, which knows the element, in a block of that many bytes; 0: enough.
std::string first_defect(const std::string& path, const InputMesh& mesh, std::size_t bytes) {
  const std::size_t enough = 65536 + 64 * (mesh.loaded.triangle_count() + mesh.loaded.vertex_count());
  const std::size_t room = bytes != 0 ? bytes : enough;
  const std::unique_ptr<unsigned char[]> block(new unsigned char[room]);
  isolod::Arena arena(block.get(), room);
  isolod::Finding finding;
  const isolod::Status status = isolod::find_defect(isolod::Span<const std::uint32_t>(mesh.loaded.triangles),
                                                    mesh.loaded.positions, mesh.loaded.vertex_count(), finding, arena);
  if (status == isolod::Status::out_of_memory) {
    fail_status(path, isolod::Status(isolod::Status::out_of_memory, isolod::Element::byte, enough));
  }
  if (!status.is_ok()) fail_status(path, status);
  if (finding.defect == Defect::none) return "";
  return describe_finding(finding) + " [" + isolod::name(finding.defect) + "]";
}

}  // namespace

const CommandRule& validate_rule() {
  static const CommandRule rule = {
      "validate",
      "IN",
      1,
      "Checks that a file holds an oriented 2-manifold without faults, and names the first rule that is broken.\n"
      "Checked are: finite positions, three different corners, no duplicate triangle, at most two triangles an edge,\n"
      "one fan of triangles a vertex, one orientation, no triangle without area, no unused vertex.\n"
      "Vertices and triangles are counted from 0.",
      {{"--memory", "SIZE", "the block to check in, such as 64M: exactly that; chosen by itself when not given"},
       {"--quiet", nullptr, "say nothing where all is well"}}};
  return rule;
}

int command_validate(const Arguments& arguments) {
  const std::string& path = arguments.operand(0);
  const InputMesh mesh = read_mesh_file(path);
  std::string fault = first_defect(path, mesh, arguments.bytes("--memory", 0));
  if (fault.empty()) fault = first_fault(facts_of(mesh));
  if (!fault.empty()) throw Failure{exit_found, path + ": " + fault};
  if (!arguments.has("--quiet")) {
    std::printf("%s: valid, %zu vertices, %zu triangles\n", path.c_str(), mesh.loaded.vertex_count(),
                mesh.loaded.triangle_count());
  }
  return exit_ok;
}

}  // namespace tool
