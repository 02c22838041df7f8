// observables.hpp: every quantity that two sets of runs have in common, brought to common bins and cells.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observable.hpp"
#include "apps/comparison/run_results.hpp"

namespace wedge {

struct RunSets {
  std::vector<RunResults> reference, compared;
  int wedge_order = 0;  // 360 degrees / angle of the wedges that were read; 0: none
};

/// What the domains of the sets have to do with each other. Pre: both sets are uniform and not empty.
Design design_of(const RunSets& sets);
/// Where the core ends, 4 d / theta [m] for the angle of the compared runs; 0: there is no core, or d is not known.
double core_radius(const RunSets& sets);
/// Whether regions core and rest exist.
bool has_core(const RunSets& sets);

/// Moments that a run of each set has, in the order of the files.
std::vector<std::string> common_moments(const RunSets& sets);
/// Whether the distributions of velocities of a moment, of every run and wedge of both sets, have all grains in the
/// two bins beside zero: only the sign of a velocity is then resolved, which of a bed at rest is that of round-off.
bool velocities_at_rest(const RunSets& sets, const std::string& moment);
/// All that both sets tell of a moment: scalars, distributions, profiles, maps; of velocities nothing where they
/// are at rest.
std::vector<Observable> observables(const RunSets& sets, const std::string& moment);

}  // namespace wedge
