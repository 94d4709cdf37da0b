// isolod_slopes: how well the samples of one chart keep to the wished density while Lloyd's relaxation goes on.
//
// The paper (section 4.4) weighs centroids with the corrected density d; its fixed point has d^(1/2) sites per area in
// the plane and d^(1/3) per length on a line (Gersho 1979; Du, Faber and Gunzburger 1999). The library's own weights
// are d^2 and d^3. Prints CSV: the slope of log(realised density) over log(wished density) after each iteration, for
// both weights on three charts where d varies 16-fold, and draws the curves. The wish itself is slope 1.
#include <cstdio>

#include "isolod/arguments.h"
#include "isolod/failure.h"
#include "plot.h"
#include "sampled_chart.h"

namespace {

using slopes::ChartCase;
using tool::Arguments;
using tool::CommandRule;

const CommandRule& slopes_rule() {
  static const CommandRule rule = {
      "slopes",
      "OUT.svg",
      1,
      "Measures how the samples' density follows the wished one over the iterations, with both weights.\n"
      "Prints CSV and draws OUT.svg.",
      {{"--vertices", "N", "samples on the chart; 1000"},
       {"--iterations", "N", "of the relaxation; 500"},
       {"--centroids", "exact|fast", "how centroids are integrated; fast"}}};
  return rule;
}

constexpr ChartCase charts[] = {
    {"density", "Flat square, density 16-fold", false, 16, false, 0.5},
    {"stretch", "Cap of the sphere, stretch 16-fold", true, 16, false, 0.5},
    {"line", "Line, density 16-fold", false, 16, true, 1.0 / 3},
};

int run(int count, char** words) {
  const Arguments arguments(slopes_rule(), count - 1, words + 1);
  if (arguments.wants_help()) {
    std::fputs(tool::help_text(slopes_rule(), "isolod_slopes").c_str(), stdout);
    return tool::exit_ok;
  }
  const auto vertices = static_cast<std::uint32_t>(arguments.count("--vertices", 1000, 20000));
  const auto iterations = static_cast<std::uint32_t>(arguments.count("--iterations", 500, 100000));
  const bool exact = arguments.choice("--centroids", {"fast", "exact"}, 0) == 1;
  const isolod::Centroids centroids = exact ? isolod::Centroids::exact : isolod::Centroids::fast;
  if (vertices < 200) tool::fail_usage("slopes: --vertices must be 200 at least");
  std::vector<slopes::Panel> panels;
  std::puts("chart,weight,samples,iteration,slope");
  for (const ChartCase& chart : charts) {
    slopes::Panel panel{chart.title, chart.limit, {}};
    for (const bool paper : {false, true}) {
      const isolod::LloydWeight weight = paper ? isolod::LloydWeight::paper : isolod::LloydWeight::equal;
      const slopes::Slopes found = slopes::measure(chart, vertices, weight, centroids, iterations);
      const char* name = paper ? "d" : chart.is_line ? "d^3" : "d^2";
      for (std::size_t i = 0; i < found.slope.size(); ++i) {
        std::printf("%s,%s,%zu,%zu,%.4f\n", chart.name, name, found.sample_count, i, found.slope[i]);
      }
      const std::string legend = std::string("weight ") + name + (paper ? ", as printed" : "");
      panel.curve.push_back({legend, paper ? draw::palette::sharp : draw::palette::boundary, found.slope});
    }
    panels.push_back(panel);
  }
  const std::string& file = arguments.operand(0);
  if (!slopes::draw_panels(file, panels)) throw tool::Failure{tool::exit_internal, "cannot write " + file};
  return tool::exit_ok;
}

}  // namespace

int main(int count, char** words) { return tool::run_program("isolod_slopes", run, count, words); }
