// isolod, the program: remeshes files and looks at them. The commands are in command_*.cpp.
#include <cstdio>
#include <cstring>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/remesh.h"

namespace {

using namespace tool;

constexpr Command commands[] = {
    {remesh_rule, command_remesh}, {lods_rule, command_lods},         {plan_rule, command_plan},
    {info_rule, command_info},     {compare_rule, command_compare},   {make_rule, command_make},
    {cut_rule, command_cut},       {validate_rule, command_validate},
};

std::string general_help() {
  std::string text =
      "isolod turns a triangle mesh into an isotropic one with an exact number of vertices.\n\n"
      "Usage: isolod COMMAND ...; isolod COMMAND --help tells more.\n\n";
  for (const Command& command : commands) {
    const CommandRule& rule = command.rule();
    const std::string summary = rule.summary;
    char line[240];
    std::snprintf(line, sizeof line, "  %-10s %s\n", rule.name, summary.substr(0, summary.find('\n')).c_str());
    text += line;
  }
  return text + "\nFile types by their endings: .obj, .off, .ply, .stl; .glb to read only.\n\n" + exit_code_help();
}

int run(int count, char** words) {
  const std::string first = count > 1 ? words[1] : "--help";
  if (first == "--help" || first == "-h" || first == "help") {
    std::fputs(general_help().c_str(), stdout);
    return count > 1 ? exit_ok : exit_usage;
  }
  if (first == "--version") {
    std::printf("isolod " ISOLOD_TOOL_VERSION ", output version %u\n", unsigned{isolod::output_version()});
    return exit_ok;
  }
  std::vector<std::string> names;
  for (const Command& command : commands) {
    const CommandRule& rule = command.rule();
    names.emplace_back(rule.name);
    if (first != rule.name) continue;
    const Arguments arguments(rule, count - 2, words + 2);
    if (!arguments.wants_help()) return command.run(arguments);
    std::fputs((help_text(rule, "isolod " + first) + "\n" + exit_code_help()).c_str(), stdout);
    return exit_ok;
  }
  const std::string near = nearest_name(first, names);
  fail_usage("unknown command '" + first + "'" + (near.empty() ? "; see isolod --help" : "; is " + near + " meant?"));
}

}  // namespace

int main(int count, char** words) { return tool::run_program("isolod", run, count, words); }
