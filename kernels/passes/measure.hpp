// measure.hpp: sums over the state that a run records.
#pragma once

#include <vector>

#include "core/state.hpp"

namespace wedge {

struct WallLoad {
  Vec3 force;   // N, of the grains on the wall
  Vec3 torque;  // N m about the origin
};

/// Load on each wall of the vessel, from the forces of the last force step. A sector's is that of one sector.
std::vector<WallLoad> wall_loads(const State& state);

/// Sum of m v [kg m/s].
Vec3 momentum(const State& state);

/// Mean kinetic energy per grain, translation and rotation [J]; 0 without grains.
double mean_kinetic_energy(const State& state);

/// FNV-1a hash (64 bits) of positions, velocities, angular velocities and histories, grain by grain in the order of
/// ids: equal for bit-identical states.
std::uint64_t state_hash(const State& state);

}  // namespace wedge
