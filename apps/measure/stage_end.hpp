// stage_end.hpp: the row of beds.csv: the bed at the end of a stage, measured from the state itself.
#pragma once

#include <string>

#include "apps/measure/discharge.hpp"
#include "apps/results/bed_table.hpp"
#include "core/state.hpp"

namespace wedge {

/// What a stage's driver knows of it.
struct FinishedStage {
  std::string name;
  double begin = 0;         // s
  double wall_seconds = 0;  // s
};

/// Numbers of the whole vessel. `crossings`: at least those of the stage.
StageResult measure_stage_end(const State& state, const MeasuredDomain& domain, const FinishedStage& stage,
                              const std::vector<Crossing>& crossings);

}  // namespace wedge
