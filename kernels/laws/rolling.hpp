// rolling.hpp: rolling resistance as a couple in each contact: a pure function on numbers, for the options
// rolling_velocity = "relative" and rolling = "elastic_plastic_spring". (The default, against a grain's own spin,
// is the limiter in integrate.hpp.)
#pragma once

#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/history.hpp"

namespace wedge {

/// One contact, or a pack of them, as rolling resistance sees it. Couples are those on the first body.
template <class Real>
struct RollingInputOf {
  Vector3<Real> spin;             // rad/s: angular velocity of the first body less that of the second
  Vector3<Real> normal;           // unit vector first -> second
  Real load{};                    // N: size of the total normal force
  Real stiffness{};               // N/m: f_cn / dn
  Real rolling{};                 // m: mu_r
  Real inertia{};                 // kg m2: effective, for the model at hand
  number_in<Real> damping_ratio;  // of critical, of the rolling spring
};
using RollingInput = RollingInputOf<double>;

/// Constant torque against the relative spin: at most mu_r |f_n|, and never more than half of what would stop the
/// two bodies within the step. (Not the whole of it: the spin seen is a predicted one, and with
/// it a couple of c I w / dt has the roots of z^2 - (1 - 3c/2) z - c/2: at c = 1 one of them is -1, a chatter that
/// never dies.) inertia: I_i I_j / (I_i + I_j), shared by the contacts of the busier body.
template <class Real>
WEDGE_INLINE Vector3<Real> relative_couple(const RollingInputOf<Real>& in, number_in<Real> dt) {
  using std::min, std::sqrt;
  const Real speed = sqrt(dot(in.spin, in.spin) + tiny<Real>);
  Real couple = in.rolling * in.load;
  if (dt > 0) couple = min(couple, constant<Real>(0.5) * in.inertia * speed / dt);
  return (-couple / speed) * in.spin;
}

/// Inertia about the contact point [kg m2] of a sphere, for the damping of the rolling spring.
template <class Real>
WEDGE_INLINE Real rocking_inertia(const Real& mass, const Real& radius) {
  return constant<Real>(2.0 / 5.0 + 1.0) * mass * radius * radius;
}

template <class Real>
struct RollingSpringOf {
  Vector3<Real> couple;  // N m
  Vector3<Real> moment;  // N m: of the spring, half a step ahead (kernels/README.md, "Stored displacement")
};
using RollingSpring = RollingSpringOf<double>;

/// Elastic-plastic rolling spring, type C of Ai, Chen, Rotter, Ooi (2011), Powder Technol. 206, 269: stiffness
/// 2.25 k_n mu_r^2 (their mu_r is ours over R*), moment at most mu_r |f_n|, viscous part while below it. Twist
/// about the normal is free. `moment` is the stored one, carried along with the contact. inertia: 1 / (1/I_i +
/// 1/I_j) with the inertias about the contact point.
template <class Real>
WEDGE_INLINE RollingSpringOf<Real> rolling_spring(const RollingInputOf<Real>& in, const Vector3<Real>& moment,
                                                  number_in<Real> dt) {
  using std::sqrt;
  const Vector3<Real> rolling = in.spin - dot(in.spin, in.normal) * in.normal;
  const Real stiffness = constant<Real>(2.25) * in.stiffness * in.rolling * in.rolling;
  const Vector3<Real> half_step = (constant<Real>(-0.5) * dt * stiffness) * rolling;
  const Vector3<Real> free = moment + half_step;
  const Real limit = in.rolling * in.load, size = norm(free);
  const auto holds = size < limit;
  const Vector3<Real> kept = select(holds, Real(1), limit / (size + tiny<Real>)) * free;
  const Real damping = select(holds, in.damping_ratio * 2 * sqrt(in.inertia * stiffness), Real(0));
  return {kept - damping * rolling, kept + half_step};
}

}  // namespace wedge
