// body_passes.hpp: the passes over grains (kicks, drift, reduction), with all types chosen: one call each per step.
#pragma once

#include <functional>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "kernels/integrate.hpp"

namespace wedge {

struct BodyPasses {
  std::function<bool(State&, double dt)> kick_and_drift;  // true: the neighbour list is stale
  std::function<void(State&)> reduce_forces;
  std::function<void(State&)> fold_images;
  std::function<void(State&, double dt)> kick;
};

BodyPasses make_body_passes(const Scene& scene, const State& state, Friction friction, bool uniform);

}  // namespace wedge
