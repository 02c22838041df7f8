// analysed_run.hpp: a run that is analysed: its folder, its stages, its domain, and the bed of each of its frames.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/measure/bed.hpp"
#include "apps/measure/measured_domain.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/results/stages.hpp"

namespace wedge {

struct AnalysedRun : MeasuredDomain {
  RunFolder folder;
  std::vector<StageRecord> stages;

  AnalysedRun(MeasuredDomain domain, RunFolder place)
      : MeasuredDomain(std::move(domain)), folder(std::move(place)) {}
  /// When the first stage that takes a wall away began [s]; nothing when none has.
  std::optional<double> opened() const { return opening_time(scene, stages); }
};

/// The run of a scene with walls, without looking into its folder. `diameter` [m]: mean of its grains. Throws
/// FileError when there is no wall.
AnalysedRun describe_run(const RunFolder& folder, Scene scene, double diameter);
/// Throws FileError when the folder holds no run, a run without frames, or one without a table of stages.
AnalysedRun open_run(const std::string& folder);

/// Reads frame `number` with its contacts, if there are any. Throws FileError.
Bed read_bed(const AnalysedRun& run, std::int64_t number);

}  // namespace wedge
