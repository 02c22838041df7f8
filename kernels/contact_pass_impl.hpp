// contact_pass_impl.hpp: the contact pass of one law in one width, with the options of a scene turned into types.
// Included once for each law and width, by source files that CMake makes of contact_pass.cpp.in.
#pragma once

#include <algorithm>
#include <variant>

#include "kernels/law_passes.hpp"
#include "kernels/laws/total_coulomb.hpp"
#include "kernels/passes/count_contacts.hpp"
#include "kernels/passes/evaluate_contacts.hpp"

namespace wedge {

/// What the grains of a scene have in common.
enum class Alike { nothing, material, material_and_radius };
template <Alike alike>
using Common = std::integral_constant<Alike, alike>;

inline std::variant<Common<Alike::nothing>, Common<Alike::material>, Common<Alike::material_and_radius>> common_to(
    const State& state, bool uniform) {
  const Particles& p = state.particles;
  if (p.count() == 0) return Common<Alike::nothing>{};
  if (uniform) return Common<Alike::material_and_radius>{};
  const bool one = std::all_of(p.material.begin(), p.material.begin() + p.count(),
                               [&](std::int32_t m) { return m == p.material[0]; });
  if (one) return Common<Alike::material>{};
  return Common<Alike::nothing>{};
}

template <class Law>
inline constexpr bool is_total_coulomb = false;
template <class Law>
inline constexpr bool is_total_coulomb<TotalCoulomb<Law>> = true;

template <class Law, class Number>
ContactPass make_contact_pass(const PairTable<typename Law::Coefficients>& table, const Scene& scene,
                              const State& state, Friction friction, bool uniform) {
  std::variant<std::false_type, std::true_type> budget;
  if (scene.output.energy_budget) budget = std::true_type{};
  const double damping = scene.contact.rolling_damping;
  return std::visit(
      [&](auto level, auto with_budget, auto in_common) -> ContactPass {
        constexpr Friction need = decltype(level)::value;
        // Made for comparison, rarely run: one loop does for all grains and budgets.
        constexpr bool compared = is_total_coulomb<Law> || has_couples(need);
        constexpr bool books = decltype(with_budget)::value || compared;
        constexpr Alike alike = compared ? Alike::nothing : decltype(in_common)::value;
        const auto pass = [damping](const auto& mix) {
          return [mix, damping](State& s, const ReactionMap& map, ForceSums& sums, double dt) {
            evaluate_contacts<Law, need, books>(mix, s, map, sums, dt, damping);
          };
        };
        const auto of_first = [&] {
          const int m = state.particles.material[0];
          return coefficients_in<Law, Number>(table(m, m));
        };
        if constexpr (alike == Alike::material_and_radius) {
          return pass(UniformMix<Law, Number>{static_cast<Number>(state.particles.radius[0]),
                                              static_cast<Number>(state.particles.mass[0]), of_first()});
        } else if constexpr (alike == Alike::material) {
          return pass(SizeMix<Law, Number>{of_first()});
        } else {
          return [table, pass](State& s, const ReactionMap& map, ForceSums& sums, double dt) {
            if constexpr (need == Friction::relative) count_contacts(s);
            pass(GeneralMix<Law, Number>{table.entries().data()})(s, map, sums, dt);
          };
        }
      },
      as_type(friction), budget, common_to(state, uniform));
}

}  // namespace wedge
