// isolod_bench: what each stage of a remeshing costs, and how that compares with other programs on the same machine.
//
// Prints CSV. Without --against, a row for each stage and one for the whole: the median over the repeats of the
// seconds, the arena's peak, and for the whole how many samples times iterations a second were relaxed. With --against,
// `isolod` and the other command run in turn (A B A B ...) as processes of their own on the same file, file reading and
// writing included, and the rows hold the medians of both, the ratio of their times, and how
// many vertices the other program gave.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "against.h"
#include "isolod/arguments.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "isolod/shapes.h"
#include "pieces.h"

namespace {

using bench::median;
using tool::Arguments;
using tool::CommandRule;
using tool::RunOutcome;

const CommandRule& bench_rule() {
  static const CommandRule rule = {
      "bench",
      "IN",
      1,
      "Times a remeshing of IN, a mesh file or the name of a made shape, and prints CSV.",
      {{"--vertices", "N", "vertices of the result"},
       {"--triangles", "N", "about how many triangles a made shape gets; 75000"},
       {"--features", "DEG", "edges sharper than this angle are kept"},
       {"--lloyd", "N", "iterations of the relaxation"},
       {"--repeat", "K", "how often; the median counts; 5"},
       {"--against", "'COMMAND {in} {out} {n}'", "another program, run in turn with isolod"},
       {"--isolod", "PATH", "the program to run in turn; beside this one when not given"},
       {"--pieces", nullptr, "instead: by stage, how many pieces of work, and how long"},
       {"--no-header", nullptr, "leave the CSV's first line out, to add to a file"}}};
  return rule;
}

struct Job {
  std::string name;  ///< for the first column
  std::string path;  ///< the input as a file
  tool::RunSettings settings;
  std::uint64_t repeats = 5;
};

/// A name in the temporary folder; the file goes with it.
struct TemporaryFile {
  std::string path;

  explicit TemporaryFile(const std::string& ending) {
    const auto ticks = std::filesystem::file_time_type::clock::now().time_since_epoch().count();
    path = (std::filesystem::temp_directory_path() / ("isolod-bench-" + std::to_string(ticks) + ending)).string();
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
};

/// The operand as a file: as it is, or a made shape written to `room`.
void find_input(const Arguments& arguments, const TemporaryFile& room, Job& job) {
  job.path = job.name = arguments.operand(0);
  shapes::ShapeInfo info;
  if (std::filesystem::exists(job.path) || !shapes::find(job.name, info)) return;
  shapes::Shape shape;
  shapes::make(job.name, static_cast<std::size_t>(arguments.count("--triangles", 75000, 100000000)), shape);
  tool::TriangleMesh mesh;
  mesh.positions = shape.positions;
  mesh.triangles = shape.triangles;
  job.path = room.path;
  tool::OutputFile file(job.path);
  tool::write_mesh_file(file, tool::write_options(job.path, false), mesh);
}

/// Seconds of the stages that relax; of all stages where there is none.
double relax_seconds(const isolod::Report& report) {
  double relaxed = 0, all = 0;
  for (std::size_t i = 0; i < report.stage_count; ++i) {
    const std::string name = report.stages[i].name;
    const bool relaxes = name.find("relax") != std::string::npos || name == "levels";
    relaxed += relaxes ? report.stages[i].seconds : 0;
    all += report.stages[i].seconds;
  }
  return relaxed > 0 ? relaxed : all;
}

void print_stages(const Job& job, const std::vector<RunOutcome>& runs, std::size_t input_triangles, bool header) {
  const isolod::Report& report = runs[0].report;
  const double samples = job.settings.options.vertex_count;
  if (header) std::puts("model,input_triangles,vertices,stage,seconds,arena_bytes,sample_iterations_per_second,hash");
  for (std::size_t i = 0; i < report.stage_count; ++i) {
    std::vector<double> seconds;
    seconds.reserve(runs.size());
    for (const RunOutcome& run : runs) seconds.push_back(run.report.stages[i].seconds);
    std::printf("%s,%zu,%.0f,%s,%.6f,%zu,,%016llx\n", job.name.c_str(), input_triangles, samples, report.stages[i].name,
                median(seconds), report.stages[i].arena_bytes, static_cast<unsigned long long>(report.stages[i].hash));
  }
  std::vector<double> seconds, rates;
  for (const RunOutcome& run : runs) {
    seconds.push_back(run.seconds);
    rates.push_back(samples * job.settings.options.lloyd_iterations / std::max(1e-9, relax_seconds(run.report)));
  }
  std::printf("%s,%zu,%.0f,all,%.6f,%zu,%.0f,%016llx\n", job.name.c_str(), input_triangles, samples, median(seconds),
              report.arena_bytes, median(rates), static_cast<unsigned long long>(report.result_hash));
}

int bench_stages(const Job& job, bool header) {
  const tool::InputMesh mesh = tool::read_mesh_file(job.path);
  std::vector<RunOutcome> runs;
  for (std::uint64_t i = 0; i < job.repeats; ++i) {
    runs.push_back(tool::run_remesh(mesh.view(), job.settings));
    if (!runs.back().status.is_ok()) tool::fail_status(job.name, runs.back().status);
    runs.back().mesh = {};
  }
  print_stages(job, runs, mesh.loaded.triangle_count(), header);
  return tool::exit_ok;
}

int bench_pieces(const Job& job, bool header) {
  const tool::InputMesh mesh = tool::read_mesh_file(job.path);
  std::vector<bench::StagePieces> stages;
  const isolod::Status status = bench::time_pieces(mesh.view(), job.settings.options, job.repeats, stages);
  if (!status.is_ok()) tool::fail_status(job.name, status);
  if (header) std::puts("model,vertices,stage,pieces,milliseconds,longest_milliseconds");
  for (const bench::StagePieces& s : stages) {
    std::printf("%s,%u,%s,%zu,%.3f,%.3f\n", job.name.c_str(), job.settings.options.vertex_count, s.stage.c_str(),
                s.count, 1e3 * s.seconds, 1e3 * s.longest_seconds);
  }
  return tool::exit_ok;
}

struct Series {
  std::vector<double> wall, cpu, peak;

  void add(const bench::ProcessTimes& times, const std::string& command) {
    if (!times.good) throw tool::Failure{tool::exit_internal, "this command failed: " + command};
    wall.push_back(times.wall_seconds);
    cpu.push_back(times.cpu_seconds);
    peak.push_back(times.peak_megabytes);
  }
};

std::string own_command(const Arguments& arguments, const char* self) {
  const std::filesystem::path beside = std::filesystem::path(self).parent_path();
  std::string program = (beside / "isolod").string();
  if (!std::filesystem::exists(program)) program = (beside / ".." / "isolod" / "isolod").string();
  program = arguments.text("--isolod", program);
  std::string command = bench::shell_quoted(program) + " remesh {in} --vertices {n} --quiet -o {out}";
  for (const char* option : {"--features", "--lloyd"}) {
    if (arguments.has(option)) command += std::string(" ") + option + " " + arguments.text(option, "");
  }
  return command;
}

/// How many vertices the other program's result has, which may not hit the wish; 0 where it wrote no mesh.
std::size_t vertices_written(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return 0;
  const std::size_t count = tool::read_mesh_file(path).loaded.vertex_count();
  std::filesystem::remove(path, error);
  return count;
}

int bench_against(const Job& job, const Arguments& arguments, const char* self, bool header) {
  const TemporaryFile out("-out.obj");
  const std::string n = std::to_string(job.settings.options.vertex_count);
  const std::string ours = bench::filled(own_command(arguments, self), job.path, out.path, n);
  const std::string theirs = bench::filled(arguments.required_text("--against"), job.path, out.path, n);
  Series a, b;
  std::size_t other_vertices = 0;
  for (std::uint64_t i = 0; i < job.repeats; ++i) {
    a.add(bench::run_process(ours), ours);
    b.add(bench::run_process(theirs), theirs);
    other_vertices = vertices_written(out.path);
  }
  if (header) {
    std::puts(
        "model,vertices,repeats,isolod_seconds,isolod_cpu_seconds,isolod_peak_mb,other_seconds,other_cpu_seconds,"
        "other_peak_mb,other_over_isolod_seconds,other_over_isolod_cpu,other_vertices");
  }
  std::printf("%s,%s,%zu,%.4f,%.4f,%.1f,%.4f,%.4f,%.1f,%.3f,%.3f,%zu\n", job.name.c_str(), n.c_str(), a.wall.size(),
              median(a.wall), median(a.cpu), median(a.peak), median(b.wall), median(b.cpu), median(b.peak),
              median(b.wall) / std::max(1e-9, median(a.wall)), median(b.cpu) / std::max(1e-9, median(a.cpu)),
              other_vertices);
  return tool::exit_ok;
}

int run(int count, char** words) {
  const Arguments arguments(bench_rule(), count - 1, words + 1);
  if (arguments.wants_help()) {
    std::fputs(tool::help_text(bench_rule(), "isolod_bench").c_str(), stdout);
    return tool::exit_ok;
  }
  Job job;
  job.settings.options.vertex_count = static_cast<std::uint32_t>(arguments.required_count("--vertices", 0xffffffffu));
  job.settings.options.feature_angle = arguments.number("--features", 0, 0, 180);
  job.settings.options.lloyd_iterations =
      static_cast<std::uint32_t>(arguments.count("--lloyd", job.settings.options.lloyd_iterations, 0xffffffffu));
  job.repeats = std::max<std::uint64_t>(1, arguments.count("--repeat", 5, 1000));
  const TemporaryFile room(".obj");
  find_input(arguments, room, job);
  const bool header = !arguments.has("--no-header");
  if (arguments.has("--pieces")) return bench_pieces(job, header);
  return arguments.has("--against") ? bench_against(job, arguments, words[0], header) : bench_stages(job, header);
}

}  // namespace

int main(int count, char** words) {
  try {
    return run(count, words);
  } catch (const tool::Failure& failure) {
    std::fprintf(stderr, "isolod_bench: %s\n", failure.message.c_str());
    return failure.exit_code;
  } catch (const std::exception& exception) {
    std::fprintf(stderr, "isolod_bench: %s\n", exception.what());
    return tool::exit_internal;
  }
}
