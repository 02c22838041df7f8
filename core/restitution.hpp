// restitution.hpp: which restitution follows from a damping ratio in a head-on impact, and the other way round.
//
// The overlap x of a Hertz contact damped by c times 2 sqrt(m* k), k = 3/2 K sqrt(x) the tangent stiffness, obeys
// m* x'' = -K x^(3/2) - c sqrt(6 m* K) x^(1/4) x'. As a function of s = x^(5/4) the velocity is that of a damped
// harmonic oscillator of ratio beta = sqrt(6/5) c: restitution depends on neither speed nor size nor stiffness.
// Antypov & Elliott (2011), EPL 94, 50004. A linear spring is that oscillator itself, beta = c.
#pragma once

#include <cmath>

#include "core/scene.hpp"

namespace wedge {

/// beta / c.
inline double oscillator_damping(ContactLaw law) { return is_hertzian(law) ? std::sqrt(6.0 / 5.0) : 1.0; }

/// Restitution of a head-on impact with damping ratio c >= 0. A contact that may pull lasts for half a period, and
/// for ever from beta = 1 on; one that may not ends when the force is zero: Schwager & Poschel (2007), Granul.
/// Matter 9, 465.
inline double restitution_of(ContactLaw law, Tension tension, double damping) {
  const double beta = oscillator_damping(law) * damping;
  if (tension == Tension::full)
    return beta < 1 ? std::exp(-3.14159265358979323846 * beta / std::sqrt(1 - beta * beta)) : 0;
  // 2 arccos(beta) / sqrt(1 - beta^2), and what it becomes beyond beta = 1
  if (std::abs(beta - 1) < 1e-9) return std::exp(-2.0);
  const double duration =
      beta < 1 ? std::acos(beta) / std::sqrt(1 - beta * beta) : std::acosh(beta) / std::sqrt(beta * beta - 1);
  return std::exp(-2 * beta * duration);
}

/// Damping ratio that gives restitution e, 0 < e <= 1.
/// A contact that may pull: Tsuji, Tanaka, Ishida (1992), Powder Technol. 71, 239, in the closed form of Antypov &
/// Elliott; one that may not: by bisection.
inline double damping_for(ContactLaw law, Tension tension, double restitution) {
  if (restitution >= 1) return 0;
  const double l = -std::log(restitution);
  if (tension == Tension::full) {
    const double share = is_hertzian(law) ? std::sqrt(5.0 / 6.0) : 1.0;
    return share * l / std::hypot(3.14159265358979323846, l);
  }
  double low = 0, high = 1;
  while (restitution_of(law, tension, high) > restitution) high *= 2;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (low + high);
    (restitution_of(law, tension, middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace wedge
