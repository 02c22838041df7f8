// fill.hpp: grains at random places, without overlap, for the start of a run.
#pragma once

#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// Grains of a random fill: random sequential addition, larger grains first; no overlap with each other, across
/// seams, with own copies (axis `images`) or with walls. Places, velocities and sizes follow from the seed alone.
/// Pre: state.symmetry and state.vessel are made. Post: state.particles holds round(count / order) grains at rest
/// but for `speed`, all forces zero. Throws SceneError when they do not find room.
void fill_at_random(State& state, const Scene& scene, const RandomFill& fill);

/// Notes in `state` what the grains have in common, mean_diameter and alike, and next_id. Once, before TimeStep is
/// made.
void describe_grains(State& state);

/// Sets what follows from radius and material: masses; and zeroes forces and lists. Pre: position, velocity,
/// angular_velocity, radius, material, id are set.
void complete_grains(Particles& particles, const std::vector<Material>& materials, double layer_height);

}  // namespace wedge
