// The bits of every stage's result, as a text file that a person can read and two machines can compare.
//
// A line is a case: what was run, then stage=hash for each stage; the first one that differs is where to look. The last
// line of each file is the output version that it was written for.
//
// To accept a change of output: raise ISOLOD_OUTPUT_VERSION in isolod/version.h, say in README.md's change list why,
// and run ISOLOD_UPDATE_GOLDEN=1 isolod_tests -tc="golden*". Without a greater number nothing that differs is written;
// cases and stages may come and go.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "isolod/version.h"
#include "support/checker.h"
#include "support/golden.h"
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

const std::string version_mark = "# output version ";

/// A golden file: its text, and the output version that it was written for; 0 for none.
struct Golden {
  std::string text;
  unsigned version = 0;
};

Golden parse(const std::string& file_text) {
  const std::size_t mark = file_text.rfind(version_mark);
  if (mark == std::string::npos) return {file_text, 0};
  return {file_text.substr(0, mark),
          static_cast<unsigned>(std::strtoul(file_text.c_str() + mark + version_mark.size(), nullptr, 10))};
}

/// By case and stage, the hash. A case is the words of its line without hashes.
std::map<std::string, std::string> hashes_of(const std::string& text) {
  std::map<std::string, std::string> hashes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name;
    for (std::string word; words >> word;) {
      const std::size_t hash = word.rfind('=') + 1;  // 0: a hash alone
      const bool is_hash = word.size() == hash + 16 && word.find_first_not_of("0123456789abcdef", hash) == word.npos;
      if (is_hash) hashes[name + " " + word.substr(0, hash)] = word.substr(hash);
      if (!is_hash) name += " " + word;
    }
  }
  return hashes;
}

/// Whether what both texts hold is different: a hash of the same stage of the same case, or any line where there are no
/// hashes.
bool has_other_bits(const std::string& old_text, const std::string& new_text) {
  const std::map<std::string, std::string> was = hashes_of(old_text), is = hashes_of(new_text);
  if (was.empty()) return !old_text.empty() && old_text != new_text;
  for (const auto& [name, hash] : was) {
    const auto found = is.find(name);
    if (found != is.end() && found->second != hash) return true;
  }
  return false;
}

/// Why this text may not replace that file; "" where it may.
std::string refusal(const Golden& old, const std::string& text, unsigned version) {
  if (version < old.version) return "the files are of a later output version than the library";
  if (version == old.version && has_other_bits(old.text, text)) {
    return "the output has changed: raise ISOLOD_OUTPUT_VERSION and say in README.md why";
  }
  return "";
}

/// Compares with the file, or writes it.
void check_golden(const std::string& file, const std::string& found) {
  CAPTURE(file);
  const Golden kept = parse(read(file));
  if (updating()) {
    REQUIRE(refusal(kept, found, ISOLOD_OUTPUT_VERSION) == "");
    std::ofstream(directory + file, std::ios::binary) << found << version_mark << ISOLOD_OUTPUT_VERSION << "\n";
    MESSAGE("written: " << directory << file);
    return;
  }
  CHECK(golden::first_difference(kept.text, found) == "");
  CHECK(kept.version == ISOLOD_OUTPUT_VERSION);  // else: ISOLOD_UPDATE_GOLDEN=1
}

std::string golden_line(const golden::Case& c) {
  const shapes::Shape shape = made(c.name, c.triangles);
  const support::Run run = support::run(view_of(shape), golden::options_of(c));
  CHECK(run.status.is_ok());
  return golden::line_of(c, run.report);
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
  for (std::size_t i = 0; i < golden::case_count; ++i) text += golden_line(golden::cases[i]);
  check_golden("stages.txt", text);
}

TEST_CASE("golden: the made shapes have the same bits") {
  std::string text, before;
  for (std::size_t i = 0; i < golden::case_count; ++i) {
    const golden::Case& c = golden::cases[i];
    if (c.name == before) continue;
    before = c.name;
    char line[100];
    std::snprintf(line, sizeof line, "%s-%zu %016" PRIx64 "\n", c.name, c.triangles,
                  checker::hash_of(made(c.name, c.triangles)));
    text += line;
  }
  check_golden("shapes.txt", text);
}

TEST_CASE("golden: the first difference is named") {
  const std::string wanted = "a x=1 y=2\nb x=3 y=4\n";
  CHECK(golden::first_difference(wanted, wanted) == "");
  CHECK(golden::first_difference(wanted, "a x=1 y=2\nb x=3 y=5\n") == "line 2 (b): y=5 instead of y=4");
  CHECK(golden::first_difference(wanted, "a x=1\nb x=3 y=4\n") == "line 1 (a):  instead of y=2");
  CHECK(golden::first_difference(wanted, "a x=1 y=2\n") == "line 2 ():  instead of b");
  CHECK(golden::first_difference("a x=1 y=2\n", wanted) == "line 2 (b): b instead of ");
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

TEST_CASE("golden: a changed hash is written only under a greater output version") {
  const std::string hash = "0123456789abcdef", other = "0123456789abcdee";
  const std::string file = "cube-12 V=5 angle=30 repair=" + hash + " lift=" + hash + "\n";
  const Golden old = parse(file + version_mark + "3\n");
  CHECK(old.text == file);
  CHECK(old.version == 3);
  CHECK(parse(file).version == 0);
  CHECK(refusal(old, file, 3) == "");
  CHECK(refusal(old, file, 4) == "");
  CHECK(refusal(old, file, 2) != "");
  const std::string changed = "cube-12 V=5 angle=30 repair=" + hash + " lift=" + other + "\n";
  CHECK(refusal(old, changed, 3) != "");
  CHECK(refusal(old, changed, 4) == "");
  CHECK(refusal(parse(""), changed, 1) == "");  // there was no such file
  // A case more, one less, a stage more, one less: no bit of what was there has changed.
  CHECK(refusal(old, file + "cube-12 V=6 angle=30 repair=" + other + "\n", 3) == "");
  CHECK(refusal(old, "cube-12 V=6 angle=30 repair=" + other + "\n", 3) == "");
  CHECK(refusal(old, "cube-12 V=5 angle=30 repair=" + hash + " mend=" + other + " lift=" + hash + "\n", 3) == "");
  CHECK(refusal(old, "cube-12 V=5 angle=30 lift=" + hash + "\n", 3) == "");
  // A shape's hash stands alone; a mesh is its numbers.
  CHECK(refusal(parse("head-20 " + hash + "\n" + version_mark + "3\n"), "head-20 " + other + "\n", 3) != "");
  CHECK(refusal(parse("OFF\n3 1 0\n" + version_mark + "3\n"), "OFF\n3 1 1\n", 3) != "");
}
