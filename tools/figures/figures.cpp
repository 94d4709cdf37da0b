// isolod_figures: draws one figure of the paper from a mesh file. tools/figures.sh calls it for all of them.
#include <cstdio>
#include <cstdlib>

#include "draw/figures.h"
#include "isolod/arguments.h"
#include "isolod/failure.h"
#include "isolod/files.h"

namespace {

using tool::Arguments;
using tool::CommandRule;

constexpr std::uint64_t most_count = 0xffffffffu;

const CommandRule& figures_rule() {
  static const CommandRule rule = {"figures",
                                   "NUMBER IN",
                                   2,
                                   "Draws one figure of the paper from IN, a mesh file.",
                                   {{"-o", "OUT", "the SVG file to write"},
                                    {"--beside", "IN2", "a second mesh, for figures 3 and 6"},
                                    {"--vertices", "N", "vertices of the result; 5000"},
                                    {"--paper", nullptr, "the paper as printed: one chart a component, seams kept"},
                                    {"--features", "DEG", "edges sharper than this angle are kept"},
                                    {"--gamma", "G", "exponent of the curvature where the figure itself sets none; 1"},
                                    {"--smooth", "N", "low-pass passes over the density"},
                                    {"--lloyd", "N", "iterations of the relaxation"},
                                    {"--toward", "X,Y,Z", "from the model to the eye; chosen when not given"},
                                    {"--up", "X,Y,Z", "upwards in the picture, with --toward; 0,1,0"},
                                    {"--closeup", "X,Y,Z", "what closer looks look at; chosen when not given"}}};
  return rule;
}

void print_help() {
  std::fputs((tool::help_text(figures_rule(), "isolod_figures") + "\n").c_str(), stdout);
  for (const draw::FigureInfo& info : draw::figures()) std::printf("  %2d  %s\n", info.number, info.title);
}

const draw::FigureInfo& figure_of(const std::string& word) {
  for (const draw::FigureInfo& info : draw::figures()) {
    if (word == std::to_string(info.number)) return info;
  }
  tool::fail_usage("no figure " + word + "; isolod_figures --help tells which there are");
}

/// Three numbers with commas between them; false where the option is not there.
bool read_triple(const Arguments& arguments, const char* option, double (&triple)[3]) {
  if (!arguments.has(option)) return false;
  const std::string text = arguments.required_text(option);
  const char* at = text.c_str();
  for (int i = 0; i < 3; ++i) {
    char* end = nullptr;
    triple[i] = std::strtod(at, &end);
    if (end == at || *end != (i == 2 ? '\0' : ',')) tool::fail_usage(std::string("option ") + option + ": not X,Y,Z");
    at = end + 1;
  }
  return true;
}

isolod::Options options_from(const Arguments& arguments) {
  const std::uint32_t vertices = static_cast<std::uint32_t>(arguments.count("--vertices", 5000, most_count));
  isolod::Options options;
  if (arguments.has("--paper")) options = isolod::paper_options(vertices);
  options.vertex_count = vertices;
  options.feature_angle = arguments.number("--features", 0, 0, 180);
  options.gamma = arguments.number("--gamma", 1, 0, 8);
  options.smoothing_passes = static_cast<std::uint32_t>(arguments.count("--smooth", 0, most_count));
  options.lloyd_iterations =
      static_cast<std::uint32_t>(arguments.count("--lloyd", options.lloyd_iterations, most_count));
  return options;
}

int run(int count, char** words) {
  const Arguments arguments(figures_rule(), count - 1, words + 1);
  if (arguments.wants_help()) {
    print_help();
    return tool::exit_ok;
  }
  const draw::FigureInfo& figure = figure_of(arguments.operand(0));
  draw::FigureTask task;
  task.file = arguments.required_text("-o");
  task.options = options_from(arguments);
  task.settings.direction_given = read_triple(arguments, "--toward", task.settings.toward);
  (void)read_triple(arguments, "--up", task.settings.up);
  task.closeup_given = read_triple(arguments, "--closeup", task.closeup);
  const tool::InputMesh mesh = tool::read_mesh_file(arguments.operand(1));
  task.view = mesh.view();
  tool::InputMesh beside;
  if (arguments.has("--beside")) {
    beside = tool::read_mesh_file(arguments.required_text("--beside"));
    task.beside = beside.view();
  }
  const isolod::Status status = figure.draw(task);
  if (!status.is_ok())
    tool::fail_status(status == isolod::Status::cannot_open ? task.file : arguments.operand(1), status);
  return tool::exit_ok;
}

}  // namespace

int main(int count, char** words) { return tool::run_program("isolod_figures", run, count, words); }
