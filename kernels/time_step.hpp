// time_step.hpp: one step of the simulation: the one place that knows the order of the passes.
#pragma once

#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/stopwatch.hpp"
#include "kernels/body_passes.hpp"
#include "kernels/law_passes.hpp"
#include "kernels/neighbours/neighbours.hpp"
#include "kernels/passes/reactions.hpp"

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

class TimeStep {
public:
  /// Chooses laws and types from the scene and from what the grains of `state` have in common. Pre:
  /// describe_grains. Post: what contacts see is kept in the scene's precision.
  TimeStep(const Scene& scene, State& state);

  /// Makes the first neighbour list and the forces of the first moment. Throws PhysicsError.
  void start(State& state, double dt);
  /// `most` steps of length dt [s], or fewer: the step in which a grain leaves is the last one. Returns their
  /// number. The result is that of single steps, to the bit. Throws PhysicsError when the physics breaks down; the
  /// state is then that moment's.
  int advance(State& state, double dt, int most = 1);
  /// Makes the next step renew the neighbour list.
  static void expire_list(State& state);
  /// Takes walls away and puts others in place, by number; the energy in contacts with the former goes with them.
  void change_walls(State& state, const std::vector<int>& remove, const std::vector<int>& add) const;

  /// Force on the first grain of each row of the contact table [N], of the last force step.
  Vec3Array contact_forces(const State& state) const { return law_.contact_forces(state); }

  Energies energies(const State& state) const;
  /// What the budget of `state.energy` leaves unexplained [J], given the energies at the start; see EnergyLedger.
  /// `history_coupling` [J] is the change of elastic tangential energy by changing overlap.
  double history_coupling(const State& state, const Energies& start, const Energies& now) const;
  double residual(const State& state, const Energies& start, const Energies& now) const;
  /// The same as three numbers, to judge how large the residual is. put_in is net of what leaving grains took
  /// along.
  EnergyBudget budget(const State& state, const Energies& start) const;

  Stopwatch& stopwatch() { return stopwatch_; }

private:
  void renew_list(State& state, double dt);
  void forces(State& state, double dt);
  void book_departures(State& state);

  Domain domain_;
  PairRules rules_;
  double smallest_margin_;  // m
  BodyPasses bodies_;
  LawPasses law_;
  NeighbourScratch scratch_;
  Reactions reactions_;
  Stopwatch stopwatch_;
};

}  // namespace wedge
