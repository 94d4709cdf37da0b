#include "isolod/progress.h"

#include <chrono>
#include <csignal>
#include <cstdio>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace tool {

namespace {

volatile std::sig_atomic_t stop_asked = 0;

extern "C" void remember_interrupt(int) { stop_asked = 1; }

}  // namespace

bool errors_go_to_terminal() {
#if defined(_WIN32)
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) != 0;
#endif
}

void ProgressLine::update(const char* stage, double share) {
  if (!shown_) return;
  const double now = now_seconds();
  if (last_ >= 0 && now - last_ < 0.1) return;
  last_ = now;
  drawn_ = true;
  std::fprintf(stderr, "\r\033[K%3.0f %%  %s", 100 * share, stage != nullptr ? stage : "");
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!drawn_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void catch_interrupts() {
  std::signal(SIGINT, remember_interrupt);
  std::signal(SIGTERM, remember_interrupt);
}

bool interrupted() { return stop_asked != 0; }

double now_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace tool
