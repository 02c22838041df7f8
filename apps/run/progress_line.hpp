// progress_line.hpp: the line that tells a person how far the run has got.
#pragma once

#include <string>

namespace wedge {

struct Progress;

/// On a terminal one line that is overwritten; elsewhere a line every 30 s.
class ProgressLine {
public:
  ProgressLine();
  /// `rate` [particle-steps/s] of this session, 0: not known; `now` [s] of this session's wall time.
  void show(const Progress& progress, double rate, double now);
  /// A line that stays.
  void note(const std::string& text);

private:
  bool terminal_;
  double last_ = -1e9;
  std::size_t width_ = 0;  // of the line on the screen
};

/// "45 s", "12 min", "3 h 20 min".
std::string duration_text(double seconds);

}  // namespace wedge
