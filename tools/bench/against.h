// Another program and ours on the same input, in turn, each as a process of its own.
#pragma once

#include <string>
#include <vector>

namespace bench {

/// What one run of a command took.
struct ProcessTimes {
  bool good = false;
  double wall_seconds = 0;
  double cpu_seconds = 0;     ///< of the process and its children, user and system
  double peak_megabytes = 0;  ///< resident
};

/// Runs a shell command with its output thrown away.
ProcessTimes run_process(const std::string& command);

/// `text` as one word of a shell command.
std::string shell_quoted(const std::string& text);

/// `command` with {in}, {out} and {n} filled in.
std::string filled(std::string command, const std::string& in, const std::string& out, const std::string& n);

double median(std::vector<double> values);

}  // namespace bench
