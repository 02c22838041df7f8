// flank.hpp: the surface of a pile, ring by ring, and the slope of its flank.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/vec3.hpp"

namespace wedge {

/// A grain of a surface.
struct Ball {
  Vec3 centre;        // m
  double radius = 0;  // m
};

/// Surface of a pile, ring by ring `width` [m] wide: mean distance from the axis and mean height [m] of the highest
/// grains, one from each cell of about one width along the ring. In a slot rings are pairs of bars along y.
std::vector<Eigen::Vector2d> mean_surface(const std::vector<Ball>& grains, double width, bool slot);

/// Height [m] of the highest ring; minus infinity without rings.
double peak_height(const std::vector<Eigen::Vector2d>& surface);

/// Slope of the surface as an angle [deg]: the line through the rings outside the highest one, between 10 and 90 %
/// of its height above the ground, by least squares. The flank ends before a ring that is missing or more than
/// `width` [m] higher than the one inside it: what lies beyond is not of the pile. Nan with fewer than four rings,
/// as on a flat bed.
double angle_of_repose(const std::vector<Eigen::Vector2d>& surface, double ground, double width);

}  // namespace wedge
