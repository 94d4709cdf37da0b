// isolod remesh: a mesh file in, an isotropic mesh file with an exact number of vertices out.
#include <cstdio>
#include <memory>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "isolod/json.h"
#include "isolod/pictures.h"
#include "isolod/progress.h"
#include "isolod/remesh_options.h"
#include "isolod/report_json.h"

namespace tool {

namespace {

void print_summary(const std::string& input, const std::string& output, const RunOutcome& outcome) {
  print_repairs(input, outcome.report.repair);
  std::printf("%s: %zu vertices, %zu triangles, %.2f s, %.1f MiB of working memory, hash %s\n", output.c_str(),
              outcome.mesh.vertex_count(), outcome.mesh.triangle_count(), outcome.seconds,
              static_cast<double>(outcome.report.arena_bytes) / 1048576,
              hex_digits(outcome.report.result_hash).c_str());
}

}  // namespace

const CommandRule& remesh_rule() {
  static const CommandRule rule = {
      "remesh", "IN", 1,
      "Remeshes a file to an exact number of vertices.\n"
      "The same input and options give the same bytes on every machine.",
      joined({{{"--vertices", "N", "vertices of the result: exactly so many"},
               {"-o", "OUT", "the file to write, only when all went well"}},
              wish_rules(),
              {{"--report", "FILE.json", "write what was done: stages, hashes, seconds, memory, repairs"},
               {"--pictures", "DIR", "draw the stages into this folder as SVG"},
               {"--paper", nullptr, "the paper as printed: one chart, its calibration, its weights, seams kept"},
               {"--keep-seams", nullptr, "all samples diffused at once, no second relaxation"}},
              method_rules()})};
  return rule;
}

int command_remesh(const Arguments& arguments) {
  const std::string& input = arguments.operand(0);
  const std::string output = arguments.required_text("-o");
  RunSettings settings = settings_from(arguments, arguments.required_count("--vertices", most_count));
  settings.watch_lloyd = arguments.has("--report");
  const isolod::WriteOptions format = write_options(output, arguments.has("--ascii"));
  OutputFile output_file(output);
  const bool pictures = arguments.has("--pictures");
  if (pictures && !can_draw()) fail_usage("remesh: this isolod was built without pictures");
  if (pictures) make_folder(arguments.required_text("--pictures"));
  std::unique_ptr<OutputFile> report;
  if (arguments.has("--report")) report = std::make_unique<OutputFile>(arguments.required_text("--report"));

  catch_interrupts();
  const InputMesh mesh = read_input(arguments);
  const isolod::MeshView view = mesh.view();
  const RunOutcome outcome = run_remesh(view, settings);
  if (report != nullptr) {
    const std::string text = report_json({input, output}, view, settings, outcome);
    report->write(text.data(), text.size());
    report->commit();
  }
  if (!outcome.status.is_ok()) fail_status(input, outcome.status);
  write_mesh_file(output_file, format, outcome.mesh);
  if (!arguments.has("--quiet")) print_summary(input, output, outcome);
  if (arguments.has("--hash")) print_hash(outcome.mesh, output);
  if (!pictures) return exit_ok;
  const std::string folder = arguments.required_text("--pictures");
  const std::size_t drawn = draw_pictures(folder, view, settings, outcome);
  if (!arguments.has("--quiet")) std::printf("%s: %zu pictures\n", folder.c_str(), drawn);
  return exit_ok;
}

}  // namespace tool
