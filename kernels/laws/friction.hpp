// friction.hpp: how much of friction a scene needs, a type of the loops.
#pragma once

namespace wedge {

/// What of the physics a scene needs; chosen once, before the loops.
enum class Friction {
  none,
  sliding,
  rolling,   // and rolling friction against a grain's own spin, by the limiter in integrate.hpp
  relative,  // and a couple in each contact against the spin of the pair
  spring     // and a couple in each contact from a rolling spring
};
constexpr bool has_couples(Friction friction) {
  return friction == Friction::relative || friction == Friction::spring;
}

}  // namespace wedge
