// integrate.hpp: the half kick of the velocity-Verlet step, with the rolling-friction limiter and the axis rules.
#pragma once

#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/passes/axis_velocity.hpp"

namespace wedge {

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

/// Angular velocity after a kick of length h by the torque t [N m] while rolling friction resists up to `cap` [N
/// m]: an exact limiter (a grain whose spin the cap can stop within the kick stops and stays). `loss`
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
    const Vector3<Real> now = at_axis<axis>(free, x, radius);
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
