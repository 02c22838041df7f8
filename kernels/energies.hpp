// energies.hpp: the energy of a moment, and what became of it since the start.
#pragma once

#include <vector>

#include "core/state.hpp"
#include "kernels/law_passes.hpp"

namespace wedge {

/// Energies of the moment [J].
struct Energies {
  double kinetic = 0, rotational = 0, elastic_normal = 0, elastic_tangential = 0, potential = 0;
  double total() const { return kinetic + rotational + elastic_normal + elastic_tangential + potential; }
};

/// What became of the energy since the start [J].
struct EnergyBudget {
  double put_in = 0;    // in motion and in contacts at the start, and given since by heights and moving walls
  double lost = 0;      // dissipated
  double residual = 0;  // unexplained
};

/// Pre: `law` is that of the contacts. `gravity` in m/s2.
Energies measure_energies(const State& state, const LawPasses& law, Vec3 gravity);

/// Change of elastic tangential energy [J] by changing overlap, since the start.
double history_coupling(const EnergyLedger& ledger, const Energies& start, const Energies& now);
/// What the ledger leaves unexplained [J]; see EnergyLedger.
double residual(const EnergyLedger& ledger, const Energies& start, const Energies& now);
/// The same as three numbers, to judge how large the residual is. put_in is net of what leaving grains took along,
/// and holds what grains brought that were put in since.
EnergyBudget energy_budget(const EnergyLedger& ledger, const Energies& start, const Energies& now);

/// Books the energy that the grains in these slots take along: their own, at the velocities that contacts see, and
/// what is stored in contacts with them. Pre: images are fresh; the slots ascend.
void book_removal(State& state, const std::vector<Index>& slots, const LawPasses& law, Vec3 gravity);
/// Books the energy that the grains from slot `from` on bring. Pre: they touch nothing.
void book_insertion(State& state, Index from, Vec3 gravity);

}  // namespace wedge
