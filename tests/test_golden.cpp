// The bits of every stage's result, as a text file that a person can read and two machines can compare.
//
// A line is a case: what was run, then stage=hash for each stage; the first one that differs is where to look. To
// accept a change of output: ISOLOD_UPDATE_GOLDEN=1 isolod_tests -tc="golden*", and say in the commit why the output
// changed.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;
using support::made;
using support::view_of;

namespace {

const std::string directory = std::string(ISOLOD_TEST_DIRECTORY) + "/golden/";

bool updating() {
  const char* value = std::getenv("ISOLOD_UPDATE_GOLDEN");
  return value != nullptr && std::string(value) == "1";
}

std::string read(const std::string& file) {
  std::ifstream in(directory + file, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

/// The first word of `found` that `wanted` has not at the same place, with its line; "" where they are equal.
std::string first_difference(const std::string& wanted, const std::string& found) {
  std::istringstream want(wanted), have(found);
  std::string wanted_line, line;
  for (int number = 1;; ++number) {
    const bool more = static_cast<bool>(std::getline(have, line)),
               expected = static_cast<bool>(std::getline(want, wanted_line));
    if (!more && !expected) return "";
    if (more && expected && line == wanted_line) continue;
    std::istringstream want_words(expected ? wanted_line : ""), have_words(more ? line : "");
    std::string begin, wanted_word, word;
    have_words >> begin;
    want_words >> wanted_word;
    for (word = begin; word == wanted_word && have_words >> word;) want_words >> wanted_word;
    return "line " + std::to_string(number) + " (" + begin + "): " + word + " instead of " + wanted_word;
  }
}

/// Compares with the file, or writes it.
void check_golden(const std::string& file, const std::string& found) {
  if (updating()) {
    std::ofstream(directory + file, std::ios::binary) << found;
    MESSAGE("written: " << directory << file);
    return;
  }
  CAPTURE(file);
  CHECK(first_difference(read(file), found) == "");
}

struct Case {
  const char* name;
  std::size_t triangles;
  std::uint32_t vertices;
  const char* note;  ///< what `change` does
  void (*change)(Options&);
};

const Case cases[] = {
    {"sphere", 1280, 500, "plain", [](Options&) {}},
    {"sphere", 1280, 2000, "plain", [](Options&) {}},
    {"head", 2000, 1000, "plain", [](Options&) {}},
    {"head", 2000, 1000, "curvature,gamma=1.5,smoothing=3",
     [](Options& o) { o.density = DensitySource::curvature, o.gamma = 1.5, o.smoothing_passes = 3; }},
    {"bracket", 800, 1500, "angle=30", [](Options& o) { o.feature_angle = 30; }},
    {"bracket", 800, 1500, "angle=30,paper-calibration,paper-weight",
     [](Options& o) { o.feature_angle = 30, o.calibration = Calibration::paper, o.weight = LloydWeight::paper; }},
    {"cube", 12, 700, "angle=30", [](Options& o) { o.feature_angle = 30; }},
    {"cube", 12, 701, "angle=30,curvature",
     [](Options& o) { o.feature_angle = 30, o.density = DensitySource::curvature; }},
    {"plate3", 600, 900, "plain", [](Options&) {}},
    {"lattice", 2000, 1200, "plain", [](Options&) {}},
    {"cylinder_open", 500, 400, "plain", [](Options&) {}},
};

std::string golden_line(const Case& c) {
  const shapes::Shape shape = made(c.name, c.triangles);
  Options options = support::with_vertices(c.vertices);
  c.change(options);
  const support::Run run = support::run(view_of(shape), options);
  CHECK(run.status.is_ok());
  std::string line =
      std::string(c.name) + "-" + std::to_string(c.triangles) + " V=" + std::to_string(c.vertices) + " " + c.note;
  for (std::size_t i = 0; i < run.report.stage_count; ++i) {
    char hash[32];
    std::snprintf(hash, sizeof hash, "%016" PRIx64, run.report.stages[i].hash);
    line += std::string(" ") + run.report.stages[i].name + "=" + hash;
  }
  return line + "\n";
}

/// An OFF file; %.17g gives every bit of a double back.
std::string off(const shapes::Shape& mesh) {
  std::string text =
      "OFF\n" + std::to_string(mesh.positions.size() / 3) + " " + std::to_string(mesh.triangles.size() / 3) + " 0\n";
  char line[100];
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", mesh.positions[i], mesh.positions[i + 1],
                  mesh.positions[i + 2]);
    text += line;
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    std::snprintf(line, sizeof line, "3 %u %u %u\n", mesh.triangles[i], mesh.triangles[i + 1], mesh.triangles[i + 2]);
    text += line;
  }
  return text;
}

}  // namespace

TEST_CASE("golden: every stage of every case gives the same bits") {
  std::string text;
  for (const Case& c : cases) text += golden_line(c);
  check_golden("stages.txt", text);
}

TEST_CASE("golden: the made shapes have the same bits") {
  std::string text, before;
  for (const Case& c : cases) {
    if (c.name == before) continue;
    before = c.name;
    char line[100];
    std::snprintf(line, sizeof line, "%s-%zu %016" PRIx64 "\n", c.name, c.triangles,
                  checker::hash_of(made(c.name, c.triangles)));
    text += line;
  }
  check_golden("shapes.txt", text);
}

TEST_CASE("golden: two small meshes, number by number") {
  const shapes::Shape sphere = made("sphere", 80), cube = made("cube", 12);
  const support::Run a = support::run(view_of(sphere), support::with_vertices(40));
  const support::Run b = support::run(view_of(cube), support::with_vertices(62, 30));
  REQUIRE(a.status.is_ok());
  REQUIRE(b.status.is_ok());
  check_golden("sphere_40.off", off(a.kept.mesh));
  check_golden("cube_62.off", off(b.kept.mesh));
}
