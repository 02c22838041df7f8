// contact_law.hpp: what every contact law takes and gives. A law is a pure function on numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/material.hpp"
#include "core/restitution.hpp"
#include "core/scene.hpp"
#include "core/vec3.hpp"

namespace wedge {

/// One contact as a law sees it. n points from the first body to the second; forces are those on the first.
struct ContactInput {
  double overlap;            // m, >= 0
  double effective_radius;   // m
  double effective_mass;     // kg
  double approach_velocity;  // m/s: v_ij . n, positive while the bodies approach
  Vec3 tangential_velocity;  // m/s: v_ij less its normal part
  Vec3 displacement;         // m: stored tangential displacement, already moved on to this moment
};

struct ContactResponse {
  double normal = 0;          // N: total normal force, positive pushes the bodies apart
  double elastic_normal = 0;  // N: |f_cn|
  Vec3 tangential;            // N
  Vec3 displacement;          // m: what is left of the displacement after sliding
  Vec3 elastic_tangential;    // N: the part of `tangential` that is not viscous
  double sliding_loss = 0;    // J lost by sliding in this step
};

/// The smallest number whose square root and inverse are finite: keeps x / |x| defined at x = 0.
inline constexpr double tiny = 1e-150;

/// 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa].
inline double effective_young(const Material& a, const Material& b) {
  return 1 / ((1 - a.poisson * a.poisson) / a.young + (1 - b.poisson * b.poisson) / b.young);
}
/// 1/G* = (2-nu1)/G1 + (2-nu2)/G2, G = E / (2 (1 + nu)) [Pa].
inline double effective_shear(const Material& a, const Material& b) {
  return 1 / (2 * (2 - a.poisson) * (1 + a.poisson) / a.young + 2 * (2 - b.poisson) * (1 + b.poisson) / b.young);
}

// Coulomb's limit is mu_s |f_cn|, of the elastic normal force, in every law. A whole contact then has the friction
// impulse mu_s m* (1 + e) v_n of a rigid body whatever its restitution, for the viscous normal force is
// proportional to d(overlap^p)/dt and has no impulse. A limit of the total normal force lets the tangential
// dashpot, which the limit leaves alone, act in the first moments of a fast impact: a third more spin at e = 0.5.

/// The least total normal force a contact may carry.
inline double lowest_normal(Tension tension) {
  return tension == Tension::none ? 0.0 : -std::numeric_limits<double>::infinity();
}

}  // namespace wedge
