// part.hpp: the parts and regions that a bed is measured in.
#pragma once

#include <limits>
#include <vector>

#include "apps/measure/measured_domain.hpp"
#include "apps/results/vocabulary.hpp"

namespace wedge {

/// A range of distances from the axis [m].
struct Region {
  RegionId id;
  double from = 0, to = std::numeric_limits<double>::infinity();
  bool holds(double r) const { return r >= from && r < to; }
};

/// All grains of the domain, or those of a wedge cut from a full vessel.
struct Part {
  PartId id;
  double begin = 0;                  // rad, azimuth where it begins
  double angle = 0;                  // rad, its width; that of the domain for the whole
  int pieces = 1;                    // so many of it make the domain
  std::vector<Region> regions;       // `all` first
  bool holds(double azimuth) const;  // Pre: azimuth in [0, 2 pi)
};

/// The domain as a whole, with the regions of its own angle.
Part whole_part(const MeasuredDomain& domain);

struct PartRequest {
  std::vector<int> orders = {4, 6, 8, 12};  // sectors in a vessel: the axis zones of a full vessel, and its wedges
  int wedges = 0;                           // of each of them
};
/// The whole first. Wedges only of a full vessel, at most as many as it has.
std::vector<Part> make_parts(const MeasuredDomain& domain, const PartRequest& request);

}  // namespace wedge
