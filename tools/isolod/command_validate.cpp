// isolod validate: whether a mesh is an oriented 2-manifold without faults, as it stands in its file.
#include <cstdio>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/mesh_facts.h"

namespace tool {

const CommandRule& validate_rule() {
  static const CommandRule rule = {
      "validate",
      "IN",
      1,
      "Checks that a file holds an oriented 2-manifold without faults, and names the first rule that is broken.\n"
      "Checked are: finite positions, three different corners, no duplicate triangle, at most two triangles an edge,\n"
      "one fan of triangles a vertex, one orientation, no triangle without area, no unused vertex.",
      {{"--quiet", nullptr, "say nothing where all is well"}}};
  return rule;
}

int command_validate(const Arguments& arguments) {
  const std::string& path = arguments.operand(0);
  const InputMesh mesh = read_mesh_file(path);
  const std::string fault = first_fault(facts_of(mesh));
  if (!fault.empty()) throw Failure{exit_found, path + ": " + fault};
  if (!arguments.has("--quiet")) {
    std::printf("%s: valid, %zu vertices, %zu triangles\n", path.c_str(), mesh.loaded.vertex_count(),
                mesh.loaded.triangle_count());
  }
  return exit_ok;
}

}  // namespace tool
