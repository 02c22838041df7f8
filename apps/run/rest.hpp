// rest.hpp: when a bed counts as being at rest.
#pragma once

#include <cmath>

#include "core/scene.hpp"

namespace wedge {

/// The scene's criterion with its defaults filled in: speed 1e-3 sqrt(g d), duration 5 sqrt(d/g), d [m] the mean
/// diameter.
inline RestCriterion rest_criterion(const Scene& scene, double mean_diameter) {
  RestCriterion rest = scene.rest;
  const double g = scene.domain.gravity.norm();
  if (rest.speed == 0) rest.speed = 1e-3 * std::sqrt(g * mean_diameter);
  if (rest.duration == 0) rest.duration = g > 0 ? 5 * std::sqrt(mean_diameter / g) : 0;
  return rest;
}

}  // namespace wedge
