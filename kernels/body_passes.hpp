// body_passes.hpp: the passes over grains (kicks and drift), with all types chosen: one call each per step.
#pragma once

#include <functional>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "kernels/integrate.hpp"

namespace wedge {

struct BodyPasses {
  std::function<bool(State&, double dt)> kick_and_drift;  // true: the neighbour list is stale
  std::function<void(State&, const Reactions&, double dt)> kick;
  std::function<void(State&, const Reactions&)> take_forces;  // alone, without a kick
};

BodyPasses make_body_passes(const Scene& scene, const State& state, Friction friction, bool uniform);

}  // namespace wedge
