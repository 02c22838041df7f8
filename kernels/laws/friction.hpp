// friction.hpp: how much of friction a scene needs, a type of the loops.
#pragma once

#include <type_traits>
#include <variant>

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

/// The level as a type, for std::visit before the loops.
inline auto as_type(Friction friction) {
  using Level = std::variant<
      std::integral_constant<Friction, Friction::none>, std::integral_constant<Friction, Friction::sliding>,
      std::integral_constant<Friction, Friction::rolling>, std::integral_constant<Friction, Friction::relative>,
      std::integral_constant<Friction, Friction::spring>>;
  switch (friction) {
    case Friction::none:
      return Level(std::in_place_index<0>);
    case Friction::sliding:
      return Level(std::in_place_index<1>);
    case Friction::rolling:
      return Level(std::in_place_index<2>);
    case Friction::relative:
      return Level(std::in_place_index<3>);
    case Friction::spring:
      break;
  }
  return Level(std::in_place_index<4>);
}

}  // namespace wedge
