// How a command ends early: one line for the user and an exit code, carried to main by an exception.
#pragma once

#include <string>
#include <utility>

#include "isolod/status.h"

namespace tool {

/// Exit codes. Scripts rely on them: a number is never given a second meaning.
enum ExitCode : int {
  exit_ok = 0,
  exit_found = 1,     ///< `validate` found a broken rule
  exit_usage = 2,     ///< the command line is wrong
  exit_internal = 3,  ///< a defect of this program
  exit_first_status = 10,
};

/// What main prints after "isolod: " and exits with.
struct Failure {
  int exit_code = exit_internal;
  std::string message;
};

/// The exit code of a status; `exit_ok` for success.
int exit_code(isolod::Status::Code code);

/// One line for a person: the element first, then what is wrong with it, then the status's name in brackets.
std::string describe(const isolod::Status& status);

/// The table of exit codes, for --help.
std::string exit_code_help();

/// All of a program's main: runs it, prints on the error stream why it failed, and gives the exit code.
int run_program(const char* program, int (*run)(int count, char** words), int count, char** words);

[[noreturn]] void fail_usage(const std::string& message);
[[noreturn]] void fail_status(const std::string& subject, const isolod::Status& status);

}  // namespace tool
