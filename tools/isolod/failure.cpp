#include "isolod/failure.h"

#include <cstdio>
#include <exception>
#include <new>

#include "isolod/self_test.h"

namespace tool {

namespace {

using isolod::Element;
using isolod::Status;

struct Meaning {
  Status::Code code;
  int exit_code;
};

// The numbers are a promise; the order is not.
constexpr Meaning meanings[] = {
    {Status::cancelled, 10},
    {Status::invalid_option, 11},
    {Status::empty_mesh, 12},
    {Status::too_large, 13},
    {Status::index_out_of_range, 14},
    {Status::position_not_finite, 15},
    {Status::density_not_positive, 16},
    {Status::budget_too_small, 17},
    {Status::out_of_memory, 18},
    {Status::no_convergence, 19},
    {Status::sink_failed, 20},
    {Status::cannot_open, 21},
    {Status::unknown_format, 22},
    {Status::syntax_error, 23},
    {Status::truncated_file, 24},
    {Status::unsupported_feature, 25},
    {Status::invalid_result, 26},
    {Status::not_admitted, 27},
    {Status::wrong_arithmetic, 28},
};

const Meaning* meaning_of(Status::Code code) {
  for (const Meaning& meaning : meanings) {
    if (meaning.code == code) return &meaning;
  }
  return nullptr;
}

/// The word on the command line for a member of `isolod::Options`, by its place there.
std::string option_name(std::uint64_t ordinal) {
  constexpr const char* names[] = {"--vertices",    "--features", "--corner",    "--density", "--gamma", "--smooth",
                                   "--calibration", "--weight",   "--centroids", "--lloyd",   "--weld"};
  return ordinal < sizeof names / sizeof names[0] ? names[ordinal] : std::to_string(ordinal);
}

std::string place_of(const Status& status) {
  const std::string number = std::to_string(status.value);
  switch (status.element) {
    case Element::vertex:
    case Element::triangle:
    case Element::edge:
      return std::string(isolod::name(status.element)) + " " + number + " (from 0): ";
    case Element::line:
      return "line " + number + ": ";
    case Element::byte:
      return status.code == Status::out_of_memory ? "" : "byte " + number + ": ";
    case Element::option:
      return "option " + option_name(status.value) + ": ";
    default:
      return "";
  }
}

std::string remedy_of(const Status& status) {
  if (status.code == Status::out_of_memory && status.element == Element::byte) {
    return ": --memory " + std::to_string(status.value) + " would do";
  }
  if (status.element == Element::count) return ": " + std::to_string(status.value) + " vertices work";
  if (status.element == Element::arithmetic) {
    return std::string(": ") + isolod::name(static_cast<isolod::ArithmeticFault>(status.value));
  }
  if (status.code == Status::unknown_format) return ": use .obj, .off, .ply, .stl or (to read) .glb";
  return "";
}

}  // namespace

int exit_code(Status::Code code) {
  if (code == Status::ok) return exit_ok;
  const Meaning* meaning = meaning_of(code);
  return meaning != nullptr ? meaning->exit_code : exit_internal;
}

std::string describe(const Status& status) {
  return place_of(status) + isolod::message(status.code) + remedy_of(status) + " [" + isolod::name(status.code) + "]";
}

std::string exit_code_help() {
  std::string text =
      "Exit codes:\n"
      "   0  success\n"
      "   1  validate found a broken rule\n"
      "   2  the command line is wrong\n"
      "   3  a defect of this program\n";
  for (const Meaning& meaning : meanings) {
    char line[160];
    std::snprintf(line, sizeof line, "  %2d  %-20s %s\n", meaning.exit_code, isolod::name(meaning.code),
                  isolod::message(meaning.code));
    text += line;
  }
  return text;
}

int run_program(const char* program, int (*run)(int count, char** words), int count, char** words) {
  const auto report = [&](int code, const char* message) {
    std::fprintf(stderr, "%s: %s\n", program, message);
    return code;
  };
  try {
    const int code = run(count, words);
    const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
    return written ? code : report(exit_code(Status::cannot_open), "standard output: write error");
  } catch (const Failure& failure) {
    return report(failure.exit_code, failure.message.c_str());
  } catch (const std::bad_alloc&) {
    return report(exit_code(Status::out_of_memory), "this machine has not enough memory for that [out_of_memory]");
  } catch (const std::exception& exception) {
    return report(exit_internal, exception.what());
  }
}

void fail_usage(const std::string& message) { throw Failure{exit_usage, message}; }

void fail_status(const std::string& subject, const Status& status) {
  throw Failure{exit_code(status.code), (subject.empty() ? "" : subject + ": ") + describe(status)};
}

}  // namespace tool
