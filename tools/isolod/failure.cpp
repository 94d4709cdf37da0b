#include "isolod/failure.h"

#include <cstdio>
#include <exception>
#include <new>

namespace tool {

namespace {

using isolod::Element;
using isolod::Status;

struct Meaning {
  Status::Code code;
  int exit_code;
  const char* text;
};

// The numbers are a promise; the order is not.
constexpr Meaning meanings[] = {
    {Status::cancelled, 10, "cancelled"},
    {Status::invalid_option, 11, "an option is out of its range"},
    {Status::empty_mesh, 12, "no triangle with area is left"},
    {Status::too_large, 13, "more elements than 32-bit indices can name"},
    {Status::index_out_of_range, 14, "names a vertex that does not exist"},
    {Status::position_not_finite, 15, "a coordinate is NaN or infinite"},
    {Status::density_not_positive, 16, "the density is not a positive finite number"},
    {Status::budget_too_small, 17, "too few vertices for the corners and the topology of this shape"},
    {Status::out_of_memory, 18, "the memory block is too small"},
    {Status::no_convergence, 19, "a bounded search ended without a usable result"},
    {Status::sink_failed, 20, "the result could not be handed over"},
    {Status::cannot_open, 21, "cannot be opened, read or written"},
    {Status::unknown_format, 22, "unknown file type"},
    {Status::syntax_error, 23, "breaks the rules of its format"},
    {Status::truncated_file, 24, "the file ends before its contents do"},
    {Status::unsupported_feature, 25, "valid, but of a kind that is not read or written here"},
    {Status::invalid_result, 26, "the result breaks one of the library's own promises; please report it"},
    {Status::not_admitted, 27, "what an option forces is not for a surface of this topology"},
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
  const Meaning* meaning = meaning_of(status.code);
  const std::string text = meaning != nullptr ? meaning->text : "failed";
  return place_of(status) + text + remedy_of(status) + " [" + isolod::name(status.code) + "]";
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
    std::snprintf(line, sizeof line, "  %2d  %-20s %s\n", meaning.exit_code, isolod::name(meaning.code), meaning.text);
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
