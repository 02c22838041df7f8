// time_step.hpp: one step of the simulation: the one place that knows the order of the passes.
#pragma once

#include <utility>
#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"
#include "core/stopwatch.hpp"
#include "kernels/body_passes.hpp"
#include "kernels/energies.hpp"
#include "kernels/law_passes.hpp"
#include "kernels/neighbours/neighbour_list.hpp"
#include "kernels/passes/departures.hpp"
#include "kernels/passes/force_sums.hpp"

namespace wedge {

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
  /// Puts grains in, between two steps, and books the energy they bring. Pre and Post as NeighbourList::insert.
  void insert(State& state, const std::vector<NewGrain>& grains);
  /// Takes walls away and puts others in place, by number; the energy in contacts with the former goes with them.
  void change_walls(State& state, const std::vector<int>& remove, const std::vector<int>& add) const;

  /// Grains that left since this was last asked, in no order.
  std::vector<Departure> take_departures() { return std::exchange(departures_, {}); }

  /// Force on the first grain of each row of the contact table [N], of the last force step.
  Vec3Array contact_forces(const State& state) const { return law_.contact_forces(state); }
  Energies energies(const State& state) const { return measure_energies(state, law_, gravity_); }

  Stopwatch& stopwatch() { return stopwatch_; }

private:
  void choose(State& state);
  void renew_list(State& state, double dt);
  void discharge(State& state);
  void forces(State& state, double dt);

  Scene scene_;
  Vec3 gravity_;  // m/s2
  BodyPasses bodies_;
  LawPasses law_;
  NeighbourList list_;
  ForceSums sums_;
  std::vector<Departure> departures_;
  Stopwatch stopwatch_;
};

}  // namespace wedge
