// isolod_paper: measures the paper's parts on meshes, beside what a whole run shows. Prints CSV. tools/check_paper.sh
// holds its rows against bars.
#include <cstdio>
#include <filesystem>

#include "isolod/arguments.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "paper/paper.h"

namespace paper {

isolod::Options options_of(const Task& task) {
  isolod::Options options;
  options.vertex_count = task.vertices;
  options.feature_angle = task.feature_angle;
  options.weld = task.weld;
  options.remove_seams = false;
  return options;
}

}  // namespace paper

namespace {

using tool::Arguments;
using tool::CommandRule;

const CommandRule& paper_rule() {
  static const CommandRule rule = {"paper",
                                   "fluencies|cuts IN",
                                   2,
                                   "Measures a part of the paper's method on IN, a mesh file, and prints CSV.\n"
                                   "fluencies: the samples of each triangle against its wish, for all three orders.\n"
                                   "cuts: lengths of the cut graphs and systems of loops of a surface with handles.",
                                   {{"--vertices", "N", "samples in all; 10000"},
                                    {"--features", "DEG", "edges sharper than this angle are features; 40"},
                                    {"--weld", nullptr, "vertices at equal positions are one"},
                                    {"--no-header", nullptr, "leave the CSV's first line out, to add to a file"}}};
  return rule;
}

int run(int count, char** words) {
  const Arguments arguments(paper_rule(), count - 1, words + 1);
  if (arguments.wants_help()) {
    std::fputs(tool::help_text(paper_rule(), "isolod_paper").c_str(), stdout);
    return tool::exit_ok;
  }
  const std::string& what = arguments.operand(0);
  if (what != "fluencies" && what != "cuts") tool::fail_usage("fluencies or cuts, not " + what);
  const std::string& path = arguments.operand(1);
  const tool::InputMesh mesh = tool::read_mesh_file(path);
  paper::Task task;
  task.name = std::filesystem::path(path).stem().string();
  task.view = mesh.view();
  task.vertices = static_cast<std::uint32_t>(arguments.count("--vertices", task.vertices, 0xffffffffu));
  task.feature_angle = arguments.number("--features", task.feature_angle, 0, 180);
  task.weld = arguments.has("--weld");
  const bool cuts = what == "cuts";
  if (!arguments.has("--no-header")) std::puts(cuts ? paper::cut_columns : paper::fluency_columns);
  const isolod::Status status = cuts ? paper::print_cuts(task) : paper::print_fluencies(task);
  if (!status.is_ok()) tool::fail_status(path, status);
  return tool::exit_ok;
}

}  // namespace

int main(int count, char** words) { return tool::run_program("isolod_paper", run, count, words); }
