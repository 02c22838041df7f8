// measured_domain.cpp: the size of a vessel from its walls.
#include "apps/measure/measured_domain.hpp"

#include <algorithm>

#include "core/time_scales.hpp"

namespace wedge {

double MeasuredDomain::cross_section() const {
  return slot ? 2 * radius * scene.domain.slot_width : numbers::pi * radius * radius;
}

MeasuredDomain describe_domain(Scene scene, const Symmetry& symmetry, double diameter) {
  MeasuredDomain domain;
  domain.scene = std::move(scene);
  domain.symmetry = symmetry;
  domain.diameter = diameter;
  domain.slot = domain.scene.domain.kind == DomainKind::slot;
  domain.order = static_cast<int>(copies_in_vessel(domain.scene.domain));
  domain.theta = 2 * numbers::pi / domain.order;
  double low = std::numeric_limits<double>::infinity(), left = low, right = -low;
  for (const WallDescription& wall : domain.scene.walls) {
    for (const Eigen::Vector2d& point : wall.profile) {
      left = std::min(left, point.x());
      right = std::max(right, point.x());
      low = std::min(low, point.y());
    }
  }
  if (!(right > 0)) return domain;
  domain.left = domain.slot ? left : 0;
  domain.radius = domain.slot ? (right - left) / 2 : right;
  domain.lowest_wall = low;
  return domain;
}

}  // namespace wedge
