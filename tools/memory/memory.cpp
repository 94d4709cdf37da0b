// isolod_memory: whether runs of one mesh keep to their memory plan, and fail cleanly with less.
//
//   isolod_memory IN --vertices N[,N...] [options of isolod remesh] [--sizes N]
//
// The block is filled with one byte and looked at afterwards, so that what was really written is counted. The least
// size that is enough is found by bisection; then `--sizes` smaller ones, spread evenly and put just below what each
// stage needs, must each fail with out_of_memory and a number of bytes, the caller's memory untouched; some of the
// numbers are tried. Prints what fails, and figures in one line; exit code 1 where anything failed.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>
#include <string>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

#include "isolod/failure.h"
#include "isolod/remesh_options.h"

namespace tool {

namespace {

using isolod::Status;

constexpr unsigned char poison = 0xa7, guard = 0x5c;
constexpr std::size_t guard_bytes = 64;

CommandRule memory_rule() {
  return {"isolod_memory", "IN", 1, "Checks that runs keep to their memory plan and fail cleanly with less.",
          joined({{{"--vertices", "N[,N...]", "vertices of the result, or of each level of detail"},
                   {"--sizes", "N", "blocks that are too small to try; 100"}},
                  wish_rules(),
                  {{"--paper", nullptr, "the paper as printed"}, {"--keep-seams", nullptr, "no second relaxation"}},
                  method_rules()})};
}

/// What a run in a block of some size came to.
struct Attempt {
  Status status;
  isolod::Report report;
  std::size_t written = 0;  ///< bytes of the block
  bool is_clean = false;    ///< nothing beside the block was written, and the arena is back
  int sink_calls = 0;
};

bool count_call(int* calls) { return ++*calls > 0; }

isolod::MeshSink counting_sink(int* calls) {
  isolod::MeshSink sink;
  sink.context = calls;
  sink.begin = [](void* c, std::size_t, std::size_t) { return count_call(static_cast<int*>(c)); };
  sink.vertices = [](void* c, const double*, std::size_t) { return count_call(static_cast<int*>(c)); };
  sink.triangles = [](void* c, const std::uint32_t*, std::size_t) { return count_call(static_cast<int*>(c)); };
  return sink;
}

class Checker {
 public:
  Checker(const isolod::MeshView& view, const RunSettings& settings) : view_(view), settings_(settings) {}

  bool run(std::size_t sizes) {
    const Status status = plan_run(view_, settings_, plan_);
    if (status == Status::budget_too_small) {
      std::printf("no run: %llu vertices are too few\n",
                  static_cast<unsigned long long>(settings_.options.vertex_count));
      return true;
    }
    if (!status.is_ok()) return complain("no plan: " + std::string(name(status.code)));
    if (!check_planned()) return false;
    find_least();
    check_smaller(sizes);
    std::printf(
        "plan %zu, peak %zu, written %zu, least %zu; plan / written %.3f, plan / least %.3f; %zu smaller sizes, "
        "%zu named, %zu of them tried\n",
        plan_.bytes, peak_, written_, least_, ratio(plan_.bytes, written_), ratio(plan_.bytes, least_), tried_,
        named_.size(), named_tried_);
    return faults_ == 0;
  }

 private:
  static double ratio(std::size_t a, std::size_t b) { return static_cast<double>(a) / static_cast<double>(b); }

  bool complain(const std::string& what) {
    if (++faults_ <= 10) std::printf("  %s\n", what.c_str());
    return false;
  }

  Attempt attempt(std::size_t bytes, bool counts = false) {
    Attempt done;
    const std::unique_ptr<unsigned char[]> memory(new unsigned char[bytes + 2 * guard_bytes]);
    std::memset(memory.get(), guard, guard_bytes);
    std::memset(memory.get() + guard_bytes + bytes, guard, guard_bytes);
    if (counts) std::memset(memory.get() + guard_bytes, poison, bytes);
    isolod::Arena arena(memory.get() + guard_bytes, bytes);
    const isolod::MeshSink sink = counting_sink(&done.sink_calls);
    if (settings_.lods.empty()) {
      done.status = isolod::remesh(view_, settings_.options, sink, &done.report, arena);
    } else {
      std::vector<isolod::LodRequest> requests;
      for (const std::uint32_t count : settings_.lods) requests.push_back({count, sink});
      done.status =
          isolod::build_lods(view_, settings_.options, {requests.data(), requests.size()}, &done.report, arena);
    }
#if defined(__SANITIZE_ADDRESS__)
    ASAN_UNPOISON_MEMORY_REGION(memory.get(), bytes + 2 * guard_bytes);  // of what the arena has given back
#endif
    done.is_clean = arena.used() == 0;
    for (std::size_t i = 0; i < guard_bytes; ++i) {
      done.is_clean = done.is_clean && memory[i] == guard && memory[guard_bytes + bytes + i] == guard;
    }
    for (std::size_t i = 0; counts && i < bytes; ++i) done.written += memory[guard_bytes + i] != poison;
    return done;
  }

  bool check_planned() {
    const Attempt run = attempt(plan_.bytes, true);
    if (!run.status.is_ok()) {
      return complain("fails in the planned " + std::to_string(plan_.bytes) + " bytes: " + name(run.status.code) + " " +
                      std::to_string(run.status.value));
    }
    report_ = run.report;
    peak_ = run.report.arena_bytes;
    written_ = run.written;
    if (!run.is_clean) complain("wrote outside of the block, or left the arena in use");
    if (peak_ > plan_.bytes) complain("peak over the plan");
    if (plan_.bytes > 2 * written_) complain("plan more than twice what was written");
    for (std::size_t i = 0; i < report_.stage_count; ++i) {
      const isolod::StageReport& stage = report_.stages[i];
      for (std::size_t k = 0; k < plan_.stage_count; ++k) {
        if (std::strcmp(plan_.stages[k].name, stage.name) != 0 || stage.arena_bytes <= plan_.stages[k].bytes) continue;
        complain(std::string(stage.name) + " takes " + std::to_string(stage.arena_bytes) + ", planned " +
                 std::to_string(plan_.stages[k].bytes));
      }
    }
    return true;
  }

  void find_least() {
    std::size_t low = 0, high = plan_.bytes;  // too small, enough
    while (high - low > 16) {
      const std::size_t middle = low + (high - low) / 2;
      (attempt(middle).status.is_ok() ? high : low) = middle;
    }
    least_ = high;
  }

  std::vector<std::size_t> smaller_sizes(std::size_t count) const {
    std::set<std::size_t> sizes{0, 1, 16, 100, least_ - 16};
    for (std::size_t i = 1; i <= count; ++i) sizes.insert(least_ * i / (count + 1));
    for (std::size_t i = 0; i < report_.stage_count; ++i) {
      for (const std::size_t less : {16, 400, 20000}) {
        if (report_.stages[i].arena_bytes > less) sizes.insert(report_.stages[i].arena_bytes - less);
      }
    }
    std::vector<std::size_t> list;
    for (const std::size_t bytes : sizes) {
      if (bytes + 16 <= least_) list.push_back(bytes);
    }
    return list;
  }

  void check_smaller(std::size_t count) {
    for (const std::size_t bytes : smaller_sizes(count)) {
      const Attempt run = attempt(bytes);
      const std::string at = "with " + std::to_string(bytes) + " bytes: ";
      ++tried_;
      if (run.status != Status::out_of_memory) {
        complain(at + name(run.status.code));
        continue;
      }
      if (run.status.element != isolod::Element::byte || run.status.value <= bytes) complain(at + "names no more");
      if (!run.is_clean) complain(at + "wrote outside of the block, or left the arena in use");
      if (run.sink_calls != 0) complain(at + "called the sink");
      named_.insert(static_cast<std::size_t>(run.status.value));
    }
    constexpr std::size_t most_tried = 6;
    for (const std::size_t bytes : named_) {
      if (named_tried_ == most_tried) break;
      ++named_tried_;
      const Attempt run = attempt(bytes);
      if (!run.status.is_ok()) complain("the named " + std::to_string(bytes) + " bytes are not enough");
      if (run.status.is_ok() && run.report.result_hash != report_.result_hash) complain("another result");
    }
  }

  const isolod::MeshView& view_;
  const RunSettings& settings_;
  isolod::MemoryPlan plan_;
  isolod::Report report_;
  std::size_t peak_ = 0, written_ = 0, least_ = 0, tried_ = 0, named_tried_ = 0;
  std::set<std::size_t> named_;
  std::uint32_t faults_ = 0;
};

int check(const Arguments& arguments) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint64_t count : arguments.required_counts("--vertices", most_count)) {
    vertices.push_back(static_cast<std::uint32_t>(count));
  }
  RunSettings settings = settings_from(arguments, *std::max_element(vertices.begin(), vertices.end()));
  if (vertices.size() > 1) settings.lods = vertices;
  const InputMesh mesh = read_input(arguments);
  const isolod::MeshView view = mesh.view();
  Checker checker(view, settings);
  return checker.run(static_cast<std::size_t>(arguments.count("--sizes", 100, most_count))) ? 0 : 1;
}

}  // namespace

}  // namespace tool

int main(int count, char** words) {
  return tool::run_program(
      "isolod_memory",
      [](int n, char** w) {
        static const tool::CommandRule rule = tool::memory_rule();
        const tool::Arguments arguments(rule, n - 1, w + 1);
        if (!arguments.wants_help()) return tool::check(arguments);
        std::fputs(tool::help_text(rule, "isolod_memory").c_str(), stdout);
        return static_cast<int>(tool::exit_ok);
      },
      count, words);
}
