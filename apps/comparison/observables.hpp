// observables.hpp: every quantity that two sets of runs have in common, brought to common bins and cells.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observable.hpp"
#include "apps/comparison/run_results.hpp"
#include "apps/results/vocabulary.hpp"

namespace wedge {

struct RunSets {
  std::vector<RunResults> reference, compared;
  int wedge_order = 0;  // 360 degrees / angle of the wedges that were read; 0: none
};

/// What the domains of the sets have to do with each other. Pre: both sets are uniform and not empty.
Design design_of(const RunSets& sets);
/// Where the axis zone of the compared runs' angle ends [m]; 0: there is none, or d is not known.
double axis_zone_radius(const RunSets& sets);
/// Whether there is an axis zone, and a rest outside it: of compared sectors.
bool has_axis_zone(const RunSets& sets);

/// Moments that a run of each set has, in the order of the files.
std::vector<std::string> common_moments(const RunSets& sets);
/// Whether the distributions of velocities of a moment, of every run and wedge of both sets, have all grains in the
/// two bins beside zero: only the sign of a velocity is then resolved, which of a bed at rest is that of round-off.
bool velocities_at_rest(const RunSets& sets, const std::string& moment);
/// Whether a quantity is compared at all: by the vocabulary, and not where a vessel's sum meets that of a slot.
bool is_compared(const ResultQuantity& quantity, const RunSets& sets);
/// All that both sets tell of a moment: scalars, distributions, profiles, maps, in the order of the vocabulary; of
/// velocities nothing where they are at rest.
std::vector<Observable> observables(const RunSets& sets, const std::string& moment);

}  // namespace wedge
