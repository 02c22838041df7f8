// body_passes.cpp: turns the options of a scene into types, for the passes over grains.
#include "kernels/body_passes.hpp"

#include <variant>

#include "kernels/passes/move.hpp"

namespace wedge {

BodyPasses make_body_passes(const Scene& scene, const State& state, Friction friction, bool uniform) {
  // What grains do differs by these alone: whence a couple comes makes no difference here.
  std::variant<std::integral_constant<Friction, Friction::none>,
               std::integral_constant<Friction, Friction::sliding>,
               std::integral_constant<Friction, Friction::rolling>>
      level;
  if (friction == Friction::sliding || has_couples(friction)) level.emplace<1>();
  if (friction == Friction::rolling) level.emplace<2>();
  const bool sector = state.symmetry.kind() == Symmetry::Kind::rotation;
  const AnyAxisAction action = as_type(sector ? traits_of(scene.domain.axis).action : AxisAction::none);
  std::variant<std::false_type, std::true_type> alike;
  if (uniform && state.particles.count() > 0) alike.emplace<1>();

  const Vec3 g{scene.domain.gravity.x(), scene.domain.gravity.y(), scene.domain.gravity.z()};
  BodyPasses passes;
  std::visit(
      [&](auto f, auto axis, auto one_kind) {
        constexpr Friction need = decltype(f)::value;
        constexpr AxisAction act = decltype(axis)::value;
        constexpr bool same = decltype(one_kind)::value;
        const Particles& p = state.particles;
        const UniformBodies one = same ? UniformBodies{p.radius[0], p.mass[0], p.material[0]} : UniformBodies{};
        const auto bodies = [one](const State& s) {
          if constexpr (same)
            return (void)s, one;
          else
            return (void)one,
                   GeneralBodies{s.particles.radius.data(), s.particles.mass.data(), s.particles.material.data()};
        };
        const auto moves = [=](auto halves) {
          return [=](State& s, const ForceSums& sums, double dt) {
            return move_grains<decltype(halves)::value, need, act>(bodies(s), s, sums, g, dt);
          };
        };
        passes.first_half = moves(std::integral_constant<Halves, Halves::first>{});
        passes.second_half = moves(std::integral_constant<Halves, Halves::second>{});
        passes.second_and_first_half = moves(std::integral_constant<Halves, Halves::second_and_first>{});
      },
      level, action, alike);
  return passes;
}

}  // namespace wedge
