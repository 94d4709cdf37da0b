// The line that tells a person at a terminal how far a run is, and Ctrl-C as a clean end.
#pragma once

namespace tool {

/// Whether standard error is a terminal.
bool errors_go_to_terminal();

/// A line on standard error that is written over and over, a few times a second at most, and erased at the end.
class ProgressLine {
 public:
  explicit ProgressLine(bool shown) : shown_(shown) {}
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void update(const char* stage, double share);
  void clear();

 private:
  bool shown_;
  bool drawn_ = false;
  double last_ = -1;
};

/// From now on Ctrl-C (and a polite kill) only makes `interrupted` true, so that a run can end without leaving files.
void catch_interrupts();
bool interrupted();

/// Seconds from a fixed moment, never going back.
double now_seconds();

}  // namespace tool
