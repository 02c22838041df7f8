// moments.hpp: the moments of a run that are analysed: ends of stages, and averages over stages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/analysis/analysed_run.hpp"

namespace wedge {

struct Moment {
  std::string name;
  bool average = false;              // over all frames of a span of time; else one frame
  double begin = 0, end = 0;         // s; of an instant both are the time of its frame
  std::vector<std::int64_t> frames;  // numbers, at least one
};

struct TimeSpan {
  double from = 0, to = 0;  // s
};

/// Times [s] of the frames of grains, by number. Throws FileError when there are none.
std::vector<double> frame_times(const RunFolder& folder);

/// Ends of the stages that have ended, and averages over those that end at a time; with a span also the average
/// over it and its last frame. Throws FileError when there is nothing to analyse.
std::vector<Moment> make_moments(const AnalysedRun& run, const std::optional<TimeSpan>& span);

}  // namespace wedge
