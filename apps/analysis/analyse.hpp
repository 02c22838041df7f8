// analyse.hpp: everything the paper measures of a run, from its frames to results/*.csv.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/analysis/moments.hpp"
#include "apps/measure/part.hpp"

namespace wedge {

struct AnalysisRequest {
  std::string folder;
  std::optional<TimeSpan> span;
  PartRequest parts;
  std::optional<double> cut;  // m, height of the horizontal cut; default 5 mean diameters above the ground
};

/// What was done, for the user.
struct AnalysisReport {
  std::vector<Moment> moments;
  std::size_t frames = 0;          // read, each once
  bool full_vessel = false;        // one that wedges can be cut from
  std::vector<std::string> files;  // written
  std::vector<std::string> notes;  // a line each: what is not as it was asked for
};

/// Reads each frame once, in order, one in memory at a time. Throws FileError.
AnalysisReport analyse(const AnalysisRequest& request);

}  // namespace wedge
