// contact_law.hpp: what every contact law takes and gives. A law is a pure function on numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/material.hpp"
#include "core/pack.hpp"
#include "core/restitution.hpp"
#include "core/scene.hpp"

namespace wedge {

/// One contact, or a pack of them, as a law sees it. n points from the first body to the second; forces are those
/// on the first.
template <class Real>
struct ContactInputOf {
  Real overlap{};                     // m, >= 0
  Real effective_radius{};            // m
  Real effective_mass{};              // kg
  Real approach_velocity{};           // m/s: v_ij . n, positive while the bodies approach
  Vector3<Real> tangential_velocity;  // m/s: v_ij less its normal part
  Vector3<Real> displacement;         // m: stored tangential displacement, already moved on to this moment
};
using ContactInput = ContactInputOf<double>;

template <class Real>
struct ContactResponseOf {
  Real normal{};                     // N: total normal force, positive pushes the bodies apart
  Real elastic_normal{};             // N: |f_cn|
  Vector3<Real> tangential;          // N
  Vector3<Real> displacement;        // m: what is left of the displacement after sliding
  Vector3<Real> elastic_tangential;  // N: the part of `tangential` that is not viscous
  Real sliding_loss{};               // J lost by sliding in this step
};
using ContactResponse = ContactResponseOf<double>;

/// Effective radius or mass of two bodies: 1 / (1/a + 1/b).
template <class Real>
WEDGE_INLINE Real effective(const Real& a, const Real& b) {
  return a * b / (a + b);
}

/// The smallest number whose square root and inverse are finite: keeps x / |x| defined at x = 0.
template <class Real>
inline constexpr number_in<Real> tiny = std::is_same_v<number_in<Real>, float> ? constant<Real>(1e-36)
                                                                               : constant<Real>(1e-150);

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

/// Elastic tangential force with a Coulomb cap [N] and a dashpot that acts while the contact sticks.
template <class Real>
WEDGE_INLINE void limit_sliding(ContactResponseOf<Real>& out, const ContactInputOf<Real>& in, const Real& stiffness,
                                const Real& damping, const Real& cap) {
  const Real length = norm(in.displacement), elastic = stiffness * length;
  const auto slides = elastic > cap;
  const Real keep = select(slides, cap / (elastic + tiny<Real>), Real(1));
  out.displacement = keep * in.displacement;
  out.elastic_tangential = (-stiffness * keep) * in.displacement;
  out.tangential = out.elastic_tangential - select(slides, Real(0), damping) * in.tangential_velocity;
  out.sliding_loss = cap * (1 - keep) * length;
}

}  // namespace wedge
