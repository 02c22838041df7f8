// integrate.hpp: the half kick of the velocity-Verlet step, with the rolling-friction limiter and the axis rules.
#pragma once

#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/friction.hpp"

namespace wedge {

/// Does the axis act on the velocities?
enum class AxisAction { none, clamp, pin };

/// A grain closer to the axis than this part of its diameter has no radial direction; the axis rule leaves it
/// alone.
inline constexpr double axis_resolution = 1e-9;

/// Velocity after a kick of length h [s] by the force f [N] and gravity g [m/s2]. Here and below: for one grain, or
/// for a pack of them.
template <class Real>
WEDGE_INLINE Vector3<Real> kicked(const Vector3<Real>& v, const Vector3<Real>& f, const Vec3& g, const Real& mass,
                                  double h) {
  const Real per_mass = 1 / mass;
  return {v.x + h * (per_mass * f.x + g.x), v.y + h * (per_mass * f.y + g.y), v.z + h * (per_mass * f.z + g.z)};
}

/// Energy [J] that a constraint takes from a grain of this mass (or inertia) in a kick from velocity v, which alone
/// would end at `free` and ends at `now`: the work of the impulse m (now - free) at the mean velocity of the kick.
/// Where the constraint holds a grain at rest against a force this is zero, while the kinetic energy of `free` is
/// not.
template <class Real>
WEDGE_INLINE Real taken(const Real& mass, const Vector3<Real>& v, const Vector3<Real>& free,
                        const Vector3<Real>& now) {
  return 0.5 * mass * dot(free - now, v + now);
}

/// The axis rule `clamp` (Yang et al. 2014, eqs 12-17): a grain whose surface reaches the axis and that moves
/// towards it loses its radial velocity.
template <class Real>
WEDGE_INLINE Vector3<Real> clamped_at_axis(const Vector3<Real>& v, const Vector3<Real>& position,
                                           const Real& radius) {
  const Real r2 = position.x * position.x + position.y * position.y;
  const Real outward = position.x * v.x + position.y * v.y;  // r v_r
  const Real nearest = 2 * axis_resolution * radius;
  const auto reaches = r2 < radius * radius && r2 >= nearest * nearest && outward < 0;
  if (!any_lane(reaches)) return v;  // most grains are far from the axis
  const Real take = select(reaches, outward / r2, Real(0.0));
  return {v.x - take * position.x, v.y - take * position.y, v.z};
}

/// Whether a grain is on the axis as the axis rule `pin` sees it: closer than 0.05 of its radius (Cui et al. 2007).
/// Such a grain no longer moves sideways, so it stays on the axis.
template <class Real>
WEDGE_INLINE auto on_axis(const Real& x, const Real& y, const Real& radius) {
  return x * x + y * y < 0.0025 * radius * radius;
}

/// The axis rule `pin`: a grain on the axis has no velocity but along it.
template <class Real>
WEDGE_INLINE Vector3<Real> pinned_at_axis(const Vector3<Real>& v, const Vector3<Real>& position,
                                          const Real& radius) {
  const Real keep = select(on_axis(position.x, position.y, radius), Real(0.0), Real(1.0));
  return {keep * v.x, keep * v.y, v.z};
}

/// Angular velocity after a kick of length h by the torque t [N m] while rolling friction resists up to `cap` [N
/// m]: an exact limiter (PHYSICS: a grain whose spin the cap can stop within the kick stops and stays). `loss`
/// grows by the energy that rolling friction takes [J].
template <class Real>
WEDGE_INLINE Vector3<Real> spun(const Vector3<Real>& w, const Vector3<Real>& t, const Real& cap,
                                const Real& inertia, double h, Real& loss) {
  using std::max, std::sqrt;
  const Real rate = h / inertia;
  const Vector3<Real> free = w + rate * t;
  const Real square = dot(free, free);
  const Real left = max(Real(0.0), 1 - rate * cap / sqrt(square + tiny<Real>));
  loss += 0.5 * inertia * (1 - left) * (dot(free, w) + left * square);  // taken() for now = left free
  return left * free;
}
template <class Real>
WEDGE_INLINE Vector3<Real> spun_freely(const Vector3<Real>& w, const Vector3<Real>& t, const Real& inertia,
                                       double h) {
  return w + (h / inertia) * t;
}

template <class Real>
struct ForcesOf {
  Vector3<Real> force, torque;  // N, N m
  Real cap{};                   // N m, what rolling friction can resist
};
template <class Real>
struct KickLossesOf {
  Real rolling{}, axis{};  // J
};

/// The half kick, of length h [s], of a grain at place x; v and w become the new velocities.
template <Friction friction, AxisAction axis, class Real>
WEDGE_INLINE void half_kick(const Real& radius, const Real& mass, const ForcesOf<Real>& f, const Vec3& gravity,
                            double h, const Vector3<Real>& x, Vector3<Real>& v, Vector3<Real>& w,
                            KickLossesOf<Real>& losses) {
  const Vector3<Real> free = kicked(v, f.force, gravity, mass, h);
  if constexpr (axis == AxisAction::none) {
    v = free;
  } else {
    const Vector3<Real> now =
        axis == AxisAction::clamp ? clamped_at_axis(free, x, radius) : pinned_at_axis(free, x, radius);
    losses.axis += taken(mass, v, free, now);
    v = now;
  }
  if constexpr (friction == Friction::rolling) {
    w = spun(w, f.torque, f.cap, sphere_inertia(mass, radius), h, losses.rolling);
  } else if constexpr (friction != Friction::none) {
    w = spun_freely(w, f.torque, sphere_inertia(mass, radius), h);
  }
}

}  // namespace wedge
