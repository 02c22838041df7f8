// moments.hpp: the moments of a run that are analysed: ends of stages, and averages over stages.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/analysis/analysed_run.hpp"
#include "apps/measure/discharge.hpp"
#include "apps/results/vocabulary.hpp"

namespace wedge {

struct Moment {
  std::string name, stage;                // stage: "" of a window
  MomentKind kind = MomentKind::instant;  // of one frame, or the mean over all frames of a span of time
  MomentRole role = MomentRole::other;
  double begin = 0, end = 0;         // s; of an instant both are the time of its frame
  std::vector<std::int64_t> frames;  // numbers, at least one
  std::vector<std::string> walls;    // present at its end
};

struct TimeSpan {
  double from = 0, to = 0;  // s
};

/// Times [s] of the frames of grains, by number. Throws FileError when there are none.
std::vector<double> frame_times(const RunFolder& folder);

/// What a bed does in a stage: rest where it has come to rest; flow once a wall was taken away by it or a stage
/// before, or where grains leave in it. Pre: run.stages has the stage.
MomentRole role_of_stage(const AnalysedRun& run, std::size_t stage, const std::vector<Crossing>& crossings);

/// Ends of the stages that have ended, and means over those that end at a time; with a span also the mean over it
/// and its last frame. Throws FileError when there is nothing to analyse.
std::vector<Moment> make_moments(const AnalysedRun& run, const std::vector<Crossing>& crossings,
                                 const std::optional<TimeSpan>& span);

}  // namespace wedge
