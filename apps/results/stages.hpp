// stages.hpp: results/stages.csv: when each stage of a run began and ended, how, and which walls stood meanwhile.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/run_folder.hpp"
#include "core/scene.hpp"
#include "core/vessel.hpp"

namespace wedge {

/// How a stage ended; `running`: not yet.
enum class StageEnd { running, at_rest, time, empty, discharged, at_most };
const char* name_of(StageEnd end);

struct StageRecord {
  std::string name;
  double begin = 0;                                       // s
  double end = std::numeric_limits<double>::quiet_NaN();  // s; nan while it runs
  StageEnd how = StageEnd::running;
  std::vector<std::string> walls;  // that are present

  bool ended() const { return how != StageEnd::running; }
};

/// Stages in their order, those that have begun. Throws FileError.
void write_stages(const std::string& path, const std::vector<StageRecord>& stages);
/// Throws FileError, with a remedy when the run has left no such file.
std::vector<StageRecord> read_stages(const RunFolder& folder);

/// The names of the walls that are present.
std::vector<std::string> walls_present(const Vessel& vessel);

/// The walls at a moment [s]: those present in the stage that had begun last before it; moving walls have gone
/// their way.
Vessel vessel_at(const Scene& scene, const std::vector<StageRecord>& stages, double time);

/// Moment [s] when the first stage that takes a wall away began; nothing when none has.
std::optional<double> opening_time(const Scene& scene, const std::vector<StageRecord>& stages);

}  // namespace wedge
