// isolod make: test shapes from nothing but a name and a size.
#include <cstdio>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "isolod/shapes.h"

namespace tool {

namespace {

void print_shapes() {
  for (const shapes::ShapeInfo& info : shapes::list()) {
    std::printf("%-12s %s (genus %d, %d loops, %d components)\n", info.name.c_str(), info.description.c_str(),
                info.genus, info.loops, info.components);
  }
}

}  // namespace

const CommandRule& make_rule() {
  static const CommandRule rule = {"make",
                                   "SHAPE",
                                   1,
                                   "Makes a test shape: isolod make list tells which there are.\n"
                                   "The same name and size give the same bytes on every machine.",
                                   {{"--triangles", "N", "about how many triangles; 20000 when not given"},
                                    {"-o", "OUT", "the file to write"},
                                    {"--ascii", nullptr, "write PLY or STL as text"},
                                    hash_rule()}};
  return rule;
}

int command_make(const Arguments& arguments) {
  const std::string& name = arguments.operand(0);
  if (name == "list") {
    print_shapes();
    return exit_ok;
  }
  const std::string path = arguments.required_text("-o");
  const isolod::WriteOptions format = write_options(path, arguments.has("--ascii"));
  const std::uint64_t triangles = arguments.count("--triangles", 20000, 100000000);
  shapes::Shape shape;
  if (!shapes::make(name, static_cast<std::size_t>(triangles), shape)) {
    std::vector<std::string> names;
    for (const shapes::ShapeInfo& info : shapes::list()) names.push_back(info.name);
    const std::string near = nearest_name(name, names);
    fail_usage("make: no shape '" + name + "'" +
               (near.empty() ? "; see isolod make list" : "; is " + near + " meant?"));
  }
  OutputFile file(path);
  TriangleMesh mesh;
  mesh.positions = std::move(shape.positions);
  mesh.triangles = std::move(shape.triangles);
  write_mesh_file(file, format, mesh);
  std::printf("%s: %zu vertices, %zu triangles\n", path.c_str(), mesh.vertex_count(), mesh.triangle_count());
  if (arguments.has("--hash")) print_hash(mesh, path);
  return exit_ok;
}

}  // namespace tool
