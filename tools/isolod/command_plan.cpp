// isolod plan: what a run would need of memory, stage by stage, before it runs.
#include <algorithm>
#include <cstdio>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/progress.h"
#include "isolod/remesh_options.h"

namespace tool {

const CommandRule& plan_rule() {
  static const CommandRule rule = {
      "plan", "IN", 1,
      "Says how much memory remesh needs for a file, or lods for several counts, and at which stage.\n"
      "The number of the last line is a --memory that is enough.",
      joined({{{"--vertices", "N[,N...]", "vertices of the result, or of each level of detail"}},
              wish_rules(),
              {{"--paper", nullptr, "the paper as printed: one chart, its calibration, its weights, seams kept"},
               {"--keep-seams", nullptr, "all samples diffused at once, no second relaxation"}},
              method_rules()})};
  return rule;
}

int command_plan(const Arguments& arguments) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint64_t count : arguments.required_counts("--vertices", most_count)) {
    vertices.push_back(static_cast<std::uint32_t>(count));
  }
  RunSettings settings = settings_from(arguments, *std::max_element(vertices.begin(), vertices.end()));
  if (vertices.size() > 1) settings.lods = vertices;

  catch_interrupts();
  const InputMesh mesh = read_input(arguments);
  isolod::MemoryPlan plan;
  const isolod::Status status = plan_run(mesh.view(), settings, plan);
  if (!status.is_ok()) fail_status(arguments.operand(0), status);
  for (std::size_t i = 0; i < plan.stage_count; ++i) {
    std::printf("%-10s %12zu\n", plan.stages[i].name, plan.stages[i].bytes);
  }
  std::printf("%-10s %12zu\n", "block", plan.bytes);
  return exit_ok;
}

}  // namespace tool
