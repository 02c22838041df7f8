// contact_kinematics.hpp: how two bodies move against each other where they touch. For one contact, or a pack.
#pragma once

#include "core/pack.hpp"

namespace wedge {

/// Velocity [m/s] of the surface of the first grain against that of the second at their contact: v, that of the
/// centres, and lever_i w_i + lever_j w_j across n, with the levers radius - overlap/2, which together are the
/// distance |d|. `spins` is w_i + w_j, `spin_difference` w_i - w_j, `longer` r_i - r_j; the last two are not asked
/// for where grains are `alike`.
template <bool alike, class Real>
WEDGE_INLINE Vector3<Real> surface_velocity(Vector3<Real> v, const Vector3<Real>& spins,
                                            const Vector3<Real>& spin_difference, const Vector3<Real>& d,
                                            const Vector3<Real>& n, const Real& longer) {
  const auto half = constant<Real>(0.5);
  v += half * cross(spins, d);
  if constexpr (!alike) v += (half * longer) * cross(spin_difference, n);
  return v;
}

/// A velocity [m/s] of the first body against the second, cut into the part along the normal and the rest.
template <class Real>
struct ContactVelocity {
  Real approach;
  Vector3<Real> tangential;
};
template <class Real>
WEDGE_INLINE ContactVelocity<Real> along_and_across(const Vector3<Real>& v, const Vector3<Real>& n) {
  const Real approach = dot(v, n);
  return {approach, v - approach * n};
}

}  // namespace wedge
