#include "plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "draw/svg.h"

namespace slopes {

using namespace draw;

namespace {

constexpr double width = 420, height = 300, margin = 56, title_depth = 40, legend_depth = 30;
constexpr double least = 0.2, most = 1.2;

class Axes {
 public:
  Axes(Vec2 corner, std::size_t iterations)
      : corner_(corner), span_(std::log(double(std::max<std::size_t>(iterations, 2)))) {}

  /// Iteration 0 lies half an octave before iteration 1.
  Vec2 at(double iteration, double value) const {
    const double start = std::log(0.7);
    const double along = ((iteration < 1 ? start : std::log(iteration)) - start) / (span_ - start);
    return corner_ + Vec2{along * width, (most - std::min(most, std::max(least, value))) / (most - least) * height};
  }

 private:
  Vec2 corner_;
  double span_;
};

std::string decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

void draw_axes(Svg& svg, const Axes& axes, const Panel& panel, std::size_t iterations) {
  const double last = static_cast<double>(iterations);
  for (const double level : {0.2, 0.4, 0.6, 0.8, 1.0, 1.2}) {
    PathData line;
    line.segment(axes.at(0, level), axes.at(last, level));
    svg.path(line, stroke_style(palette::faint, level == 1 ? 1.6 : 0.7));
    svg.text(axes.at(0, level) + Vec2{-6, 4}, 12, palette::quiet_ink, decimal(level), Anchor::end);
  }
  PathData limit;
  limit.segment(axes.at(0, panel.limit), axes.at(last, panel.limit));
  svg.path(limit, stroke_style(palette::sharp, 0.7, 0.6));
  svg.text(axes.at(last, panel.limit) + Vec2{4, 4}, 11, palette::sharp, decimal(panel.limit));
  for (std::size_t i = 1; i <= iterations; i *= 10) {
    for (const std::size_t tick : {i, 5 * i}) {
      if (tick > iterations) continue;
      const Vec2 foot = axes.at(static_cast<double>(tick), least);
      PathData line;
      line.segment(foot, foot + Vec2{0, 5});
      svg.path(line, stroke_style(palette::quiet_ink, 0.8));
      svg.text(foot + Vec2{0, 18}, 12, palette::quiet_ink, std::to_string(tick), Anchor::middle);
    }
  }
}

}  // namespace

bool draw_panels(const std::string& file, const std::vector<Panel>& panels) {
  const double step = width + 2 * margin;
  Svg svg(step * static_cast<double>(panels.size()), title_depth + height + 2 * margin + legend_depth);
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Panel& panel = panels[p];
    const Vec2 corner{step * static_cast<double>(p) + margin, title_depth + margin / 2};
    std::size_t iterations = 1;
    for (const Curve& curve : panel.curve) iterations = std::max(iterations, curve.value.size() - 1);
    const Axes axes(corner, iterations);
    svg.text(corner + Vec2{0, -30}, 15, palette::ink, panel.title);
    svg.text(corner + Vec2{0, -12}, 12, palette::quiet_ink,
             "slope of log realised over log wished density, by iteration");
    draw_axes(svg, axes, panel, iterations);
    Vec2 entry = corner + Vec2{0, height + 44};
    for (const Curve& curve : panel.curve) {
      PathData line;
      line.move_to(axes.at(0, curve.value[0]));
      for (std::size_t i = 1; i < curve.value.size(); ++i)
        line.line_to(axes.at(static_cast<double>(i), curve.value[i]));
      svg.path(line, stroke_style(curve.colour, 2));
      svg.text(entry, 13, curve.colour, curve.name);
      entry = entry + Vec2{0, 18};
    }
  }
  return svg.write(file);
}

}  // namespace slopes
