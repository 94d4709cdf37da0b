#include "support/golden.h"

using namespace isolod;

namespace golden {

const Case cases[] = {
    {"sphere", 1280, 300, "plain", [](Options&) {}},
    {"sphere", 1280, 2020, "plain", [](Options&) {}},
    {"head", 2000, 400, "plain", [](Options&) {}},
    {"head", 2000, 400, "curvature,gamma=1.5,smoothing=3",
     [](Options& o) { o.density = DensitySource::curvature, o.gamma = 1.5, o.smoothing_passes = 3; }},
    {"bracket", 800, 800, "angle=30", [](Options& o) { o.feature_angle = 30; }},
    {"bracket", 800, 200, "angle=30,paper-calibration,paper-weight",
     [](Options& o) { o.feature_angle = 30, o.calibration = Calibration::paper, o.weight = LloydWeight::paper; }},
    {"cube", 12, 200, "angle=30", [](Options& o) { o.feature_angle = 30; }},
    {"cube", 12, 201, "angle=30,curvature",
     [](Options& o) { o.feature_angle = 30, o.density = DensitySource::curvature; }},
    {"plate3", 600, 400, "plain", [](Options&) {}},
    {"lattice", 2000, 500, "plain", [](Options&) {}},
    {"cylinder_open", 500, 200, "plain", [](Options&) {}},
};
const std::size_t case_count = sizeof cases / sizeof cases[0];

namespace {

std::string hexadecimal(std::uint64_t value) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[value >> shift & 15];
  return text;
}

/// Takes the text up to the next of these characters, and that character too.
std::string take_until(const std::string& text, std::size_t& at, char end) {
  const std::size_t begin = at < text.size() ? at : text.size(), found = text.find(end, begin);
  const std::size_t stop = found == std::string::npos ? text.size() : found;
  at = stop + 1;
  return text.substr(begin, stop - begin);
}

}  // namespace

Options options_of(const Case& c) {
  Options options;
  options.vertex_count = c.vertices;
  c.change(options);
  return options;
}

std::string title_of(const Case& c) {
  return std::string(c.name) + "-" + std::to_string(c.triangles) + " V=" + std::to_string(c.vertices) + " " + c.note;
}

std::string line_of(const Case& c, const Report& report) {
  std::string line = title_of(c);
  for (std::size_t i = 0; i < report.stage_count; ++i) {
    line += std::string(" ") + report.stages[i].name + "=" + hexadecimal(report.stages[i].hash);
  }
  return line + "\n";
}

std::string first_difference(const std::string& wanted, const std::string& found) {
  std::size_t want_at = 0, at = 0;
  for (int number = 1; want_at < wanted.size() || at < found.size(); ++number) {
    const std::string want_line = take_until(wanted, want_at, '\n'), line = take_until(found, at, '\n');
    if (line == want_line) continue;
    std::size_t want_word_at = 0, word_at = 0;
    std::string want_word, word, begin;
    while (word == want_word && (word_at <= line.size() || want_word_at <= want_line.size())) {
      want_word = take_until(want_line, want_word_at, ' ');
      word = take_until(line, word_at, ' ');
      if (begin.empty()) begin = word;
    }
    return "line " + std::to_string(number) + " (" + begin + "): " + word + " instead of " + want_word;
  }
  return "";
}

}  // namespace golden
