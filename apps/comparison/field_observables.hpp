// field_observables.hpp: profiles and maps of two sets of runs as samples on common cells.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observables.hpp"

namespace wedge {

/// Columns of radial.csv (Kind::profile) or map.csv (Kind::map) of a moment; regions core and rest where
/// `core_radius` [m] is above 0.
std::vector<Observable> field_observables(const RunSets& sets, const std::string& moment, Kind kind,
                                          double core_radius);

}  // namespace wedge
