// The golden cases on any machine, boards without an operating system included: each stage's bits against those that
// tests/golden holds. Prints a line a case; the last one is `N passed, N failed`. The library's memory is one static
// block.
#include "support/golden.h"

#include <string>

#include "golden_lines.h"
#include "isolod/self_test.h"
#include "platform.h"
#include "support/float_mode.h"

namespace {

ISOLOD_STATIC_BLOCK unsigned char block[ISOLOD_BLOCK_BYTES];

int passed = 0, failed = 0;

void verdict(const std::string& name, const std::string& fault) {
  ++(fault.empty() ? passed : failed);
  platform::say(((fault.empty() ? "ok  " + name : "BAD " + name + ": " + fault) + "\n").c_str());
}

/// The lines of the text that begin with this title and a space.
std::string lines_of(const std::string& text, const std::string& title) {
  std::string found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    if (text.compare(at, title.size() + 1, title + " ") == 0) found += text.substr(at, end - at);
    at = end;
  }
  return found;
}

isolod::MeshView view_of(const shapes::Shape& shape) {
  isolod::MeshView view;
  view.positions = shape.positions.data();
  view.vertex_count = shape.positions.size() / 3;
  view.indices = shape.triangles.data();
  view.triangle_count = shape.triangles.size() / 3;
  return view;
}

isolod::Status remesh(const golden::Case& c, const shapes::Shape& shape, isolod::Report& report) {
  isolod::Arena arena(block, sizeof block);
  return isolod::remesh(view_of(shape), golden::options_of(c), {}, &report, arena);
}

void judge(const golden::Case& c, const std::string& note, const isolod::Status& status, const isolod::Report& report) {
  const std::string title = golden::title_of(c);
  const std::string name = title + note + ", " + std::to_string(report.arena_bytes >> 10) + " KB";
  if (!status.is_ok()) {
    return verdict(name, std::string(isolod::name(status.code)) + " " + std::to_string(status.value));
  }
  verdict(name, golden::first_difference(lines_of(golden::wanted_lines, title), golden::line_of(c, report)));
}

shapes::Shape made(const golden::Case& c) {
  shapes::Shape shape;
  if (!shapes::make(c.name, c.triangles, shape)) verdict(c.name, "no such shape");
  return shape;
}

void run(const golden::Case& c) {
  const shapes::Shape shape = made(c);
  isolod::Report report;
  const isolod::Status status = remesh(c, shape, report);
  judge(c, "", status, report);
}

void test_arithmetic(const std::string& name, isolod::TestedMode mode) {
  const isolod::Status status = isolod::self_test(mode);
  verdict(name, status.is_ok() ? "" : isolod::name(static_cast<isolod::ArithmeticFault>(status.value)));
}

/// Once more, in floating-point modes that are not the library's.
void run_in_other_modes(const golden::Case& c) {
#if defined(ISOLOD_TEST_MODES)
  const shapes::Shape shape = made(c);
  for (const std::uint64_t mode : {support::flushes_to_zero, support::rounds_up, support::rounds_to_zero}) {
    isolod::Report report;
    isolod::Status status;
    bool is_kept = false;
    {
      const support::WithFloatMode with(mode);
      const std::uint64_t before = support::float_mode();
      status = remesh(c, shape, report);
      is_kept = support::float_mode() == before;
    }
    judge(c, mode == support::flushes_to_zero ? ", flushing" : ", rounding otherwise", status, report);
    if (!is_kept) verdict("the mode is as it was", "it is not");
  }
#else
  (void)c;
#endif
}

}  // namespace

int main() {
  test_arithmetic("arithmetic of the thread", isolod::TestedMode::as_found);
  test_arithmetic("arithmetic in calls", isolod::TestedMode::as_in_calls);
  const golden::Case* least = nullptr;
  for (std::size_t i = 0; i < golden::case_count; ++i) {
    const golden::Case& c = golden::cases[i];
    if (c.vertices > ISOLOD_MOST_VERTICES) continue;
    if (least == nullptr || c.vertices < least->vertices) least = &c;
    run(c);
  }
  if (least != nullptr) run_in_other_modes(*least);
  platform::say((std::to_string(passed) + " passed, " + std::to_string(failed) + " failed\n").c_str());
  return failed == 0 && least != nullptr ? 0 : 1;
}
