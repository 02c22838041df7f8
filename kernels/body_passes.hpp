// body_passes.hpp: the passes over grains, with all types chosen: one call each per step.
#pragma once

#include <functional>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/passes/force_sums.hpp"

namespace wedge {

struct BodyPasses {
  // See move.hpp; true: the neighbour list is stale.
  std::function<bool(State&, const ForceSums&, double dt)> first_half, second_half, second_and_first_half;
};

BodyPasses make_body_passes(const Scene& scene, const State& state, Friction friction, bool uniform);

}  // namespace wedge
