// history.hpp: how a stored tangential displacement is carried along with its contact. For one contact or a pack.
#pragma once

#include "core/pack.hpp"

namespace wedge {

/// Turns a vector that is perpendicular to the unit vector `before` by the smallest rotation that takes `before` to
/// the unit vector `now`: u - (before + now) (now . u) / (1 + before . now). Exact; keeps the length.
template <class Real>
WEDGE_INLINE Vector3<Real> follow_normal(const Vector3<Real>& u, const Vector3<Real>& before,
                                         const Vector3<Real>& now) {
  const Real factor = dot(now, u) / (1 + dot(before, now));
  return u - factor * (before + now);
}

/// The same where `before` is now + back, but for its length, and `back` is small and perpendicular to `now`.
/// Without its terms of fourth order in `back`: u - (now . u) (now + back/2).
template <class Real>
WEDGE_INLINE Vector3<Real> follow_turning_normal(const Vector3<Real>& u, const Vector3<Real>& back,
                                                 const Vector3<Real>& now) {
  return u - dot(now, u) * (now + constant<Real>(0.5) * back);
}

/// Turns u, perpendicular to the unit vector n, about n by the angle 2 atan(half_angle) ~ 2 half_angle.
/// The Cayley form of a rotation: keeps the length exactly, the angle to third order.
template <class Real>
WEDGE_INLINE Vector3<Real> spin_about_normal(const Vector3<Real>& u, const Vector3<Real>& n,
                                             const plain_t<Real>& half_angle) {
  const Real square = half_angle * half_angle;
  const Real scale = 1 / (1 + square);
  return (scale * (1 - square)) * u + (2 * half_angle * scale) * cross(n, u);
}

/// The same for what a contact stores, in a step of dt [s]: its two bodies, whose angular velocities together are
/// `spins` [rad/s], turn it by their mean.
template <class Real>
WEDGE_INLINE Vector3<Real> turn_with_spins(const Vector3<Real>& u, const Vector3<Real>& n,
                                           const Vector3<Real>& spins, number_in<Real> dt) {
  return spin_about_normal(u, n, constant<Real>(0.25) * dt * dot(spins, n));
}

/// Time [s] by which a displacement grows in a force step, at the tangential velocity of the step's end: half of dt
/// for a contact that was there before (the other half is in `stored`; kernels/README.md, "Stored displacement"),
/// and all the time since first touch, overlap over approach velocity [m/s], for a new one. A contact is new when
/// nothing is stored; one that was there and has never slipped grows from zero velocity, so the difference is of
/// order dt^2.
template <class Real>
WEDGE_INLINE Real slip_time(const Vector3<Real>& stored, const Real& overlap, const Real& approach_velocity,
                            number_in<Real> dt) {
  const auto is_new = stored.x == 0 && stored.y == 0 && stored.z == 0 && overlap > 0;
  const Real half_step(dt / 2);
  if (__builtin_expect(!any_lane(is_new), 1)) return half_step;  // few contacts are new
  const Real whole_step(dt);
  const Real since_touch = select(approach_velocity * dt > overlap, overlap / approach_velocity, whole_step);
  return select(is_new, since_touch, half_step);
}

}  // namespace wedge
