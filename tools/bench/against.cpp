#include "against.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

#include "isolod/progress.h"

namespace bench {

namespace {

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// The child's side: never returns.
[[noreturn]] void become(const char* command) {
  const int nowhere = open("/dev/null", O_RDWR);
  if (nowhere >= 0) {
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
  }
  execl("/bin/sh", "sh", "-c", command, static_cast<char*>(nullptr));
  _exit(127);
}

}  // namespace

ProcessTimes run_process(const std::string& command) {
  ProcessTimes times;
  const double start = tool::now_seconds();
  const pid_t child = fork();
  if (child == 0) become(command.c_str());
  if (child < 0) return times;
  int status = 0;
  rusage usage = {};
  if (wait4(child, &status, 0, &usage) != child) return times;
  times.wall_seconds = tool::now_seconds() - start;
  times.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
#if defined(__APPLE__)
  times.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1048576;
#else
  times.peak_megabytes = static_cast<double>(usage.ru_maxrss) / 1024;
#endif
  times.good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return times;
}

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') {
      quoted += "'\\''";
    } else {
      quoted += c;
    }
  }
  return quoted + "'";
}

std::string filled(std::string command, const std::string& in, const std::string& out, const std::string& n) {
  const std::pair<std::string, std::string> places[] = {
      {"{in}", shell_quoted(in)}, {"{out}", shell_quoted(out)}, {"{n}", n}};
  for (const auto& [place, value] : places) {
    for (std::size_t at = command.find(place); at != std::string::npos; at = command.find(place, at + value.size())) {
      command.replace(at, place.size(), value);
    }
  }
  return command;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

}  // namespace bench
