// walls_at.hpp: the walls of a run as they stood at a moment.
#pragma once

#include "apps/results/run_folder.hpp"
#include "core/scene.hpp"
#include "core/vessel.hpp"

namespace wedge {

/// Stages that had begun before `time` [s] have removed and added theirs; moving walls have gone their way. Reads
/// when stages ended from the table of beds. Throws FileError.
Vessel walls_at(const Scene& scene, const RunFolder& folder, double time);

}  // namespace wedge
