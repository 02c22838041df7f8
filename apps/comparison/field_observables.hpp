// field_observables.hpp: profiles and maps of two sets of runs as samples on common cells.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observables.hpp"

namespace wedge {

/// The wanted columns of radial.csv (Kind::profile) or map.csv (Kind::map) of a moment, as far as every table has
/// them, in every region that has cells.
std::vector<Observable> field_observables(const RunSets& sets, const std::string& moment, Kind kind,
                                          const std::vector<const ResultQuantity*>& wanted);

}  // namespace wedge
