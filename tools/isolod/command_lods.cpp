// isolod lods: a mesh file in, several levels of detail out, each a file with an exact number of vertices.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/progress.h"
#include "isolod/remesh_options.h"

namespace tool {

namespace {

std::vector<std::uint32_t> vertices_from(const Arguments& arguments) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint64_t count : arguments.required_counts("--vertices", most_count)) {
    const std::uint32_t wished = static_cast<std::uint32_t>(count);
    if (std::find(vertices.begin(), vertices.end(), wished) != vertices.end()) {
      fail_usage("option --vertices: " + std::to_string(wished) + " is given twice");
    }
    vertices.push_back(wished);
  }
  return vertices;
}

/// "folder/name.obj" with 300 vertices is "folder/name-300.obj".
std::string name_of(const std::string& output, std::uint32_t vertices) {
  std::filesystem::path path = output;
  const std::string ending = path.extension().string();
  path.replace_filename(path.stem().string() + "-" + std::to_string(vertices) + ending);
  return path.string();
}

void print_summary(const std::string& input, const std::vector<std::unique_ptr<OutputFile>>& files,
                   const RunOutcome& outcome) {
  print_repairs(input, outcome.report.repair);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::printf("%s: %zu vertices, %zu triangles\n", files[i]->path().c_str(), outcome.lods[i].vertex_count(),
                outcome.lods[i].triangle_count());
  }
  std::printf("%s: %zu levels of detail, %.2f s, %.1f MiB of working memory\n", input.c_str(), files.size(),
              outcome.seconds, static_cast<double>(outcome.report.arena_bytes) / 1048576);
}

}  // namespace

const CommandRule& lods_rule() {
  static const CommandRule rule = {
      "lods", "IN", 1,
      "Makes several levels of detail of a file in one run.\n"
      "OUT.obj with --vertices 5000,300 is OUT-5000.obj and OUT-300.obj; none is written unless all are good.",
      joined({{{"--vertices", "N,N,...", "vertices of each level: exactly so many"},
               {"-o", "OUT", "the files to write; each gets its number of vertices into its name"}},
              wish_rules(),
              method_rules()})};
  return rule;
}

int command_lods(const Arguments& arguments) {
  const std::string& input = arguments.operand(0);
  const std::vector<std::uint32_t> vertices = vertices_from(arguments);
  const std::string output = arguments.required_text("-o");
  RunSettings settings = settings_from(arguments, *std::max_element(vertices.begin(), vertices.end()));
  settings.lods = vertices;
  const isolod::WriteOptions format = write_options(output, arguments.has("--ascii"));
  std::vector<std::unique_ptr<OutputFile>> files;
  files.reserve(vertices.size());
  for (const std::uint32_t count : vertices) files.push_back(std::make_unique<OutputFile>(name_of(output, count)));

  catch_interrupts();
  const InputMesh mesh = read_input(arguments);
  const RunOutcome outcome = run_remesh(mesh.view(), settings);
  if (!outcome.status.is_ok()) fail_status(input, outcome.status);
  for (std::size_t i = 0; i < files.size(); ++i) write_mesh_file(*files[i], format, outcome.lods[i]);
  if (!arguments.has("--quiet")) print_summary(input, files, outcome);
  for (std::size_t i = 0; arguments.has("--hash") && i < files.size(); ++i) {
    print_hash(outcome.lods[i], files[i]->path());
  }
  return exit_ok;
}

}  // namespace tool
