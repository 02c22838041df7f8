// law_passes_impl.hpp: the passes of one law with the options of a scene turned into types: all but contacts, whose
// loops have source files of their own (contact_pass_impl.hpp).
#pragma once

#include <functional>
#include <variant>

#include "kernels/law_passes.hpp"
#include "kernels/passes/contact_forces.hpp"
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

template <class Law>
LawPasses make_law_passes(const Scene& scene, const State& state, Friction friction, bool uniform) {
  const auto table = prepare_table<Law>(scene);
  const WallMix<Law> walls(table, state.vessel);
  const double damping = scene.contact.rolling_damping;
  LawPasses passes;
  passes.elastic_energy = [table, walls](const State& s, const std::function<bool(Index)>& counts) {
    return elastic_energy<Law>(table, walls, s, counts);
  };
  passes.contact_forces = [table, friction](const State& s) { return contact_forces<Law>(table, friction, s); };
  passes.evaluate_contacts = scene.run.precision == Precision::mixed
                                 ? make_contact_pass<Law, float>(table, scene, state, friction, uniform)
                                 : make_contact_pass<Law, double>(table, scene, state, friction, uniform);
  std::visit(
      [&](auto level) {
        passes.evaluate_walls = [walls, damping](State& s, ForceSums& sums, double dt) {
          evaluate_walls<Law, decltype(level)::value>(walls, s, sums, dt, damping);
        };
      },
      as_type(friction));
  return passes;
}

}  // namespace wedge
