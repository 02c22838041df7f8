// rolling.hpp: rolling resistance as a couple in each contact: a pure function on numbers, for the options
// rolling_velocity = "relative" and rolling = "elastic_plastic_spring". (The default, against a grain's own spin,
// is the limiter in integrate.hpp.)
#pragma once

#include "kernels/contact_law.hpp"
#include "kernels/history.hpp"

namespace wedge {

/// One contact as rolling resistance sees it. Couples are those on the first body.
struct RollingInput {
  Vec3 spin;             // rad/s: angular velocity of the first body less that of the second
  Vec3 normal;           // unit vector first -> second
  double load;           // N: size of the total normal force
  double stiffness;      // N/m: f_cn / dn
  double rolling;        // m: mu_r
  double inertia;        // kg m2: effective, for the model at hand
  double damping_ratio;  // of critical, of the rolling spring
};

/// Constant torque against the relative spin: at most mu_r |f_n|, and never more than half of what would stop the
/// two bodies within the step. (PHYSICS, section 1, has the whole; but the spin seen is a predicted one, and with
/// it a couple of c I w / dt has the roots of z^2 - (1 - 3c/2) z - c/2: at c = 1 one of them is -1, a chatter that
/// never dies.) inertia: I_i I_j / (I_i + I_j), shared by the contacts of the busier body.
inline Vec3 relative_couple(const RollingInput& in, double dt) {
  const double speed = std::sqrt(dot(in.spin, in.spin) + tiny);
  const double most = dt > 0 ? 0.5 * in.inertia * speed / dt : std::numeric_limits<double>::infinity();
  return (-std::min(in.rolling * in.load, most) / speed) * in.spin;
}

/// Inertia about the contact point [kg m2] of a sphere, for the damping of the rolling spring.
inline double rocking_inertia(double mass, double radius) { return (2.0 / 5.0 + 1.0) * mass * radius * radius; }

struct RollingSpring {
  Vec3 couple;  // N m
  Vec3 moment;  // N m: of the spring, half a step ahead (kernels/README.md, "Stored displacement")
};

/// Elastic-plastic rolling spring, type C of Ai, Chen, Rotter, Ooi (2011), Powder Technol. 206, 269: stiffness
/// 2.25 k_n mu_r^2 (their mu_r is ours over R*), moment at most mu_r |f_n|, viscous part while below it. Twist
/// about the normal is free. `moment` is the stored one, carried along with the contact. inertia: 1 / (1/I_i +
/// 1/I_j) with the inertias about the contact point.
inline RollingSpring rolling_spring(const RollingInput& in, Vec3 moment, double dt) {
  const Vec3 rolling = in.spin - dot(in.spin, in.normal) * in.normal;
  const double stiffness = 2.25 * in.stiffness * in.rolling * in.rolling;
  const Vec3 half_step = (-0.5 * dt * stiffness) * rolling;
  const Vec3 free = moment + half_step;
  const double limit = in.rolling * in.load, size = norm(free);
  RollingSpring out;
  if (size < limit) {
    out.couple = free - (in.damping_ratio * 2 * std::sqrt(in.inertia * stiffness)) * rolling;
    out.moment = free + half_step;
  } else {
    const Vec3 kept = (limit / (size + tiny)) * free;
    out.couple = kept;
    out.moment = kept + half_step;
  }
  return out;
}

}  // namespace wedge
