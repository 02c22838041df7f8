// law_passes_impl.hpp: turns the options of a scene into types, for one law. Included once per law.
#pragma once

#include <algorithm>
#include <functional>
#include <variant>

#include "kernels/law_passes.hpp"
#include "kernels/laws/total_coulomb.hpp"
#include "kernels/passes/contact_forces.hpp"
#include "kernels/passes/count_contacts.hpp"
#include "kernels/passes/evaluate_contacts.hpp"
#include "kernels/passes/evaluate_walls.hpp"

namespace wedge {

template <class Law>
PairTable<typename Law::Coefficients> prepare_table(const Scene& scene) {
  const int kinds = static_cast<int>(scene.materials.size());
  PairTable<typename Law::Coefficients> table(kinds);
  for (int a = 0; a < kinds; ++a)
    for (int b = 0; b <= a; ++b)
      table(a, b) =
          Law::prepare(scene.materials[static_cast<std::size_t>(a)], scene.materials[static_cast<std::size_t>(b)],
                       scene.interactions(a, b), scene.contact);
  return table;
}

/// Elastic energy of the contacts in the tables, from overlap and stored displacement.
/// A contact of a grain with its own copy half a turn away is shared by both, so half of it counts.
template <class Law>
ElasticEnergy elastic_energy(const PairTable<typename Law::Coefficients>& table, const WallMix<Law>& walls,
                             const State& state, const std::function<bool(Index)>& counts) {
  const Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  ElasticEnergy sum;
  for (Index k = 0; k < c.rows(); ++k) {
    const auto r = static_cast<std::size_t>(k);
    const double depth = row_overlap(state, r);
    if (!(depth > 0)) continue;
    const auto i = static_cast<std::size_t>(c.first[r]), j = static_cast<std::size_t>(c.second[r]);
    if (counts && !counts(c.first[r]) && !counts(row_partner(state, r).grain)) continue;
    const double radius = effective(p.radius[i], p.radius[j]), mass = effective(p.mass[i], p.mass[j]);
    const auto& coefficients = table(p.material[i], p.material[j]);
    const double part = row_is_shared(state, r) ? 0.5 : 1.0;
    sum.normal += part * Law::normal_energy(coefficients, radius, mass, depth);
    sum.tangential += part * Law::tangential_energy(coefficients, radius, mass, depth, norm(c.history.get(r)));
  }
  const WallContactTable& w = state.wall_contacts;
  for (std::size_t g = 0; g < w.grain.size(); ++g) {
    const auto i = static_cast<std::size_t>(w.grain[g]);
    if (counts && !counts(w.grain[g])) continue;
    for (auto k = static_cast<std::size_t>(w.begin[g]); k < static_cast<std::size_t>(w.begin[g + 1]); ++k) {
      if (!w.touching[k]) continue;
      const int wall = state.vessel.carrier(w.feature[k]);
      if (wall < 0) continue;
      const auto& coefficients = walls[walls.slot(p.material[i], wall)];
      sum.normal += Law::normal_energy(coefficients, p.radius[i], p.mass[i], w.overlap[k]);
      sum.tangential +=
          Law::tangential_energy(coefficients, p.radius[i], p.mass[i], w.overlap[k], norm(w.history.get(k)));
    }
  }
  return sum;
}

template <Friction friction>
using Level = std::integral_constant<Friction, friction>;

/// What the grains of a scene have in common. `uniform` in what follows: radius and material are those of all.
enum class Alike { nothing, material, material_and_radius };
template <Alike alike>
using Common = std::integral_constant<Alike, alike>;

inline Alike common_to(const State& state, bool uniform) {
  const Particles& p = state.particles;
  const auto n = static_cast<std::size_t>(p.count());
  if (n == 0) return Alike::nothing;
  if (uniform) return Alike::material_and_radius;
  const bool one = std::all_of(p.material.begin(), p.material.begin() + p.count(),
                               [&](std::int32_t m) { return m == p.material[0]; });
  return one ? Alike::material : Alike::nothing;
}

template <class Law>
inline constexpr bool is_total_coulomb = false;
template <class Law>
inline constexpr bool is_total_coulomb<TotalCoulomb<Law>> = true;

template <class Law>
LawPasses make_law_passes(const Scene& scene, const State& state, Friction friction, bool uniform) {
  const auto table = prepare_table<Law>(scene);
  const WallMix<Law> walls(table, state.vessel);
  LawPasses passes;
  passes.elastic_energy = [table, walls](const State& s, const std::function<bool(Index)>& counts) {
    return elastic_energy<Law>(table, walls, s, counts);
  };

  std::variant<Level<Friction::none>, Level<Friction::sliding>, Level<Friction::rolling>, Level<Friction::relative>,
               Level<Friction::spring>>
      level;
  if (friction == Friction::sliding) level.template emplace<1>();
  if (friction == Friction::rolling) level.template emplace<2>();
  if (friction == Friction::relative) level.template emplace<3>();
  if (friction == Friction::spring) level.template emplace<4>();
  std::variant<std::false_type, std::true_type> budget;
  if (scene.output.energy_budget) budget = std::true_type{};
  std::variant<Common<Alike::nothing>, Common<Alike::material>, Common<Alike::material_and_radius>> common;
  if (common_to(state, uniform) == Alike::material) common.template emplace<1>();
  if (common_to(state, uniform) == Alike::material_and_radius) common.template emplace<2>();
  std::variant<double, float> width;
  if (scene.run.precision == Precision::mixed) width = 0.0f;

  const double damping = scene.contact.rolling_damping;
  std::visit(
      [&](auto f, auto with_budget, auto in_common, auto number) {
        using Number = decltype(number);
        constexpr Friction need = decltype(f)::value;
        constexpr bool books = decltype(with_budget)::value;
        constexpr bool compared =
            is_total_coulomb<Law> || has_couples(need);  // rarely run: one loop does for all grains and budgets
        constexpr Alike alike = compared ? Alike::nothing : decltype(in_common)::value;
        const auto pass = [damping](const auto& mix) {
          return [mix, damping](State& s, const ReactionMap& map, ForceSums& sums, double dt) {
            evaluate_contacts<Law, need, books || compared>(mix, s, map, sums, dt, damping);
          };
        };
        const auto of_first = [&] {
          const int m = state.particles.material[0];
          return coefficients_in<Law, Number>(table(m, m));
        };
        passes.evaluate_walls = [walls, damping](State& s, ForceSums& sums, double dt) {
          evaluate_walls<Law, need, Number>(walls, s, sums, dt, damping);
        };
        passes.contact_forces = [table](const State& s) { return contact_forces<Law>(table, need, s); };
        if constexpr (alike == Alike::material_and_radius) {
          passes.evaluate_contacts =
              pass(UniformMix<Law, Number>{static_cast<Number>(state.particles.radius[0]),
                                           static_cast<Number>(state.particles.mass[0]), of_first()});
        } else if constexpr (alike == Alike::material) {
          passes.evaluate_contacts = pass(SizeMix<Law, Number>{of_first()});
        } else {
          passes.evaluate_contacts = [table, pass](State& s, const ReactionMap& map, ForceSums& sums, double dt) {
            if constexpr (need == Friction::relative) count_contacts(s);
            pass(GeneralMix<Law, Number>{table.entries().data()})(s, map, sums, dt);
          };
        }
      },
      level, budget, common, width);
  return passes;
}

}  // namespace wedge
