// departures.hpp: which grains leave through the outlet.
#pragma once

#include <vector>

#include "core/state.hpp"

namespace wedge {

/// A grain that left through the outlet.
struct Departure {
  double time = 0;  // s, when its centre crossed the outlet height
  std::int32_t id = 0;
  std::int32_t layer = 0;
  Vec3 position, velocity;  // m, m/s, when it was taken out
  double mass = 0;          // kg
};

/// Slots of the grains whose centre is below `outlet` [m], ascending. Pre: what contacts see is that of now. Throws
/// PhysicsError when one of them is beside the vessel, where it cannot have come through the outlet.
std::vector<Index> grains_below(const State& state, double outlet);

/// The departure, now, of the grain in this slot.
Departure departure_of(const State& state, Index slot, double outlet);

}  // namespace wedge
