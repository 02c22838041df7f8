// energies.cpp: sums of energies, and the ledger's balance.
#include "kernels/energies.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace wedge {
namespace {

/// Energy [J] of the grain in slot i at these velocities: kinetic, rotational, potential.
double energy_of_grain(const Particles& p, std::size_t i, Vec3 v, Vec3 w, Vec3 gravity) {
  return 0.5 * p.mass[i] * dot(v, v) + 0.5 * sphere_inertia(p.mass[i], p.radius[i]) * dot(w, w) -
         p.mass[i] * dot(gravity, p.position.get(i));
}

}  // namespace

Energies measure_energies(const State& state, const LawPasses& law, Vec3 gravity) {
  const Particles& p = state.particles;
  Energies e = reduce_blocks(
      p.count(), Energies{},
      [&](Index begin, Index end) {
        Energies sum;
        for (Index i = begin; i < end; ++i) {
          const auto s = static_cast<std::size_t>(i);
          const Vec3 v = p.velocity.get(s), w = p.angular_velocity.get(s);
          sum.kinetic += 0.5 * p.mass[s] * dot(v, v);
          sum.rotational += 0.5 * sphere_inertia(p.mass[s], p.radius[s]) * dot(w, w);
          sum.potential -= p.mass[s] * dot(gravity, p.position.get(s));
        }
        return sum;
      },
      [](Energies a, const Energies& b) {
        a.kinetic += b.kinetic;
        a.rotational += b.rotational;
        a.potential += b.potential;
        return a;
      });
  const ElasticEnergy stored = law.elastic_energy(state, {});
  e.elastic_normal = stored.normal;
  e.elastic_tangential = stored.tangential;
  return e;
}

double history_coupling(const EnergyLedger& l, const Energies& start, const Energies& now) {
  return now.elastic_tangential + l.elastic_tangential_removed - start.elastic_tangential - l.tangential_work +
         l.sliding;
}

double residual(const EnergyLedger& l, const Energies& start, const Energies& now) {
  return now.total() - start.total() - l.carried_in + l.carried_out - l.wall_work -
         history_coupling(l, start, now) + l.normal_damping + l.tangential_damping + l.sliding + l.rolling + l.axis;
}

EnergyBudget energy_budget(const EnergyLedger& l, const Energies& start, const Energies& now) {
  const double given = start.potential - now.potential + l.carried_in - l.carried_out + l.wall_work;
  return {start.total() - start.potential + std::max(given, 0.0),
          l.normal_damping + l.tangential_damping + l.sliding + l.rolling + l.axis, residual(l, start, now)};
}

void book_removal(State& state, const std::vector<Index>& slots, const LawPasses& law, Vec3 gravity) {
  const Particles& p = state.particles;
  for (const Index i : slots) {
    const auto s = static_cast<std::size_t>(i);
    const Seen seen = p.seen.get(s);
    state.energy.carried_out += energy_of_grain(p, s, seen.velocity, seen.angular_velocity, gravity);
  }
  const ElasticEnergy stored =
      law.elastic_energy(state, [&](Index i) { return std::binary_search(slots.begin(), slots.end(), i); });
  state.energy.carried_out += stored.normal + stored.tangential;
  state.energy.elastic_tangential_removed += stored.tangential;
}

void book_insertion(State& state, Index from, Vec3 gravity) {
  const Particles& p = state.particles;
  for (auto s = static_cast<std::size_t>(from); s < static_cast<std::size_t>(p.count()); ++s)
    state.energy.carried_in += energy_of_grain(p, s, p.velocity.get(s), p.angular_velocity.get(s), gravity);
}

}  // namespace wedge
