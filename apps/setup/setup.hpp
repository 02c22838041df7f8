// setup.hpp: from a checked scene to the state of the first moment.
#pragma once

#include <string>

#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// The whole starting state: random fill, state file, or another run's checkpoint with its contact histories.
/// Throws SceneError when grains find no room or lie outside the domain, FileError when a file cannot be read.
State make_start(const Scene& scene);

/// Throws FileError unless a state read from `path` has the materials and the couples of the scene it shall go on
/// in.
void require_fit(const State& state, const Scene& scene, const std::string& path);

/// What to say of a start without grains: legal, since a sector may be empty, but seldom meant.
std::string no_grains_text(const Scene& scene);

/// Step length [s] of a stage: its own, the scene's, or, when that is auto, the chosen one. Throws SceneError when
/// there is no grain to choose it by.
double stage_time_step(const Scene& scene, const State& state, const Stage& stage);

}  // namespace wedge
