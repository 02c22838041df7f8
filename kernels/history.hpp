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

/// Time [s] by which a displacement grows in a force step, at the tangential velocity of the step's end: half of dt
/// for a contact that was there before (the other half is in `stored`; kernels/README.md, "Stored displacement"),
/// and all the time since first touch, overlap over approach velocity [m/s], for a new one. A contact is new when
/// nothing is stored; one that was there and has never slipped grows from zero velocity, so the difference is of
/// order dt^2.
inline double slip_time(Vec3 stored, double overlap, double approach_velocity, double dt) {
  const bool is_new = stored.x == 0 && stored.y == 0 && stored.z == 0;
  const double since_touch = approach_velocity * dt > overlap ? overlap / approach_velocity : dt;
  return is_new ? since_touch : 0.5 * dt;
}

}  // namespace wedge
