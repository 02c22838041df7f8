// progress_line.cpp: writes progress to standard error.
#include "apps/run/progress_line.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "io/tables/provenance.hpp"

namespace wedge {

std::string duration_text(double seconds) {
  char text[48];
  const long s = std::lround(seconds);
  if (s < 100)
    std::snprintf(text, sizeof text, "%ld s", s);
  else if (s < 6000)
    std::snprintf(text, sizeof text, "%ld min", (s + 30) / 60);
  else
    std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s % 3600 / 60);
  return text;
}

ProgressLine::ProgressLine() : terminal_(isatty(STDERR_FILENO) != 0) {}

void ProgressLine::show(const Progress& p, double rate, double now) {
  if (now - last_ < (terminal_ ? 0.5 : 30.0)) return;
  last_ = now;
  char text[256];
  std::snprintf(text, sizeof text, "%s (%d/%d)  t %.4f s  step %lld  %lld grains, %lld out", p.stage.c_str(),
                p.stage_number, p.stage_count, p.time, static_cast<long long>(p.step),
                static_cast<long long>(p.grains), static_cast<long long>(p.discharged));
  std::string line = text;
  if (rate > 0) {
    std::snprintf(text, sizeof text, "  %.1f M particle-steps/s", 1e-6 * rate);
    line += text;
  }
  if (p.eta_seconds >= 0) line += "  ETA " + duration_text(p.eta_seconds);
  if (!terminal_) {
    std::fprintf(stderr, "%s\n", line.c_str());
    return;
  }
  const std::size_t width = line.size();
  if (width < width_) line.append(width_ - width, ' ');
  width_ = width;
  std::fprintf(stderr, "\r%s", line.c_str());
  std::fflush(stderr);
}

void ProgressLine::note(const std::string& text) {
  if (terminal_ && width_ > 0) std::fprintf(stderr, "\r%*s\r", static_cast<int>(width_), "");
  width_ = 0;
  std::fprintf(stderr, "%s\n", text.c_str());
}

}  // namespace wedge
