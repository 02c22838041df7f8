// history.hpp: how a stored tangential displacement is carried along with its contact.
#pragma once

#include "core/vec3.hpp"

namespace wedge {

/// Turns a vector that is perpendicular to the unit vector `before` by the smallest rotation that takes `before` to
/// the unit vector `now`: u - (before + now) (now . u) / (1 + before . now). Exact; keeps the length.
inline Vec3 follow_normal(Vec3 u, Vec3 before, Vec3 now) {
  const double factor = dot(now, u) / (1 + dot(before, now));
  return u - factor * (before + now);
}

/// Turns u, perpendicular to the unit vector n, about n by the angle 2 atan(half_angle) ~ 2 half_angle.
/// The Cayley form of a rotation: keeps the length exactly, the angle to third order.
inline Vec3 spin_about_normal(Vec3 u, Vec3 n, double half_angle) {
  const double square = half_angle * half_angle;
  const double scale = 1 / (1 + square);
  return (scale * (1 - square)) * u + (2 * half_angle * scale) * cross(n, u);
}

}  // namespace wedge
