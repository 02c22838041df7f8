// linear_law.hpp: spring and dashpot in both directions with a Coulomb cap.
// Cundall & Strack (1979), Geotechnique 29, 47; stiffness from the contact time: Luding (2008), Granul. Matter 10,
// 235.
#pragma once

#include "kernels/laws/contact_law.hpp"

namespace wedge {

struct LinearLaw {
  template <class Real>
  struct CoefficientsOf {
    Real stiffness;           // N/m, k_n when it is given
    Real stiffness_per_mass;  // 1/s2, k_n / m* when the contact time is given: (pi^2 + ln^2 e) / t_c^2
    Real tangential_ratio;    // k_t / k_n
    Real sliding;             // mu_s
    Real rolling;             // mu_r, m
    Real damping_normal;      // ratio of critical
    Real damping_tangential;  // ratio of critical
    Real lowest_normal;       // N

    /// Each coefficient from `get`, called with the member of Coefficients.
    template <class Get>
    static CoefficientsOf from(Get&& get) {
      using One = CoefficientsOf<double>;
      return {get(&One::stiffness),
              get(&One::stiffness_per_mass),
              get(&One::tangential_ratio),
              get(&One::sliding),
              get(&One::rolling),
              get(&One::damping_normal),
              get(&One::damping_tangential),
              get(&One::lowest_normal)};
    }
  };
  using Coefficients = CoefficientsOf<double>;

  static Coefficients prepare(const Material&, const Material&, const Interaction& c, const ContactModel& model) {
    const double c_n =
        c.restitution ? damping_for(ContactLaw::linear, model.tension, *c.restitution) : c.damping_normal;
    const double c_t = c.restitution ? c_n : c.damping_tangential;
    // contact time: half a period of the damped oscillator, t_c = pi / (omega_0 sqrt(1 - c_n^2))
    const double omega =
        model.contact_time > 0 ? 3.14159265358979323846 / (model.contact_time * std::sqrt(1 - c_n * c_n)) : 0;
    return {model.contact_time > 0 ? 0 : model.normal_stiffness,
            omega * omega,
            model.tangential_ratio,
            c.sliding,
            c.rolling,
            c_n,
            c_t,
            lowest_normal(model.tension)};
  }

  template <class Number, class Real>
  static Real normal_stiffness(const CoefficientsOf<Number>& c, const Real& effective_mass) {
    return c.stiffness + c.stiffness_per_mass * effective_mass;
  }

  static void remove_friction(Coefficients& c) { c.sliding = c.rolling = 0; }

  template <class Number, class Real>
  WEDGE_INLINE static ContactResponseOf<Real> respond(const CoefficientsOf<Number>& c,
                                                      const ContactInputOf<Real>& in) {
    using std::max, std::sqrt;
    ContactResponseOf<Real> out;
    const Real k_n = normal_stiffness(c, in.effective_mass);
    const Real critical = 2 * sqrt(in.effective_mass * k_n);
    out.elastic_normal = k_n * in.overlap;
    out.normal =
        max(Real(c.lowest_normal), out.elastic_normal + c.damping_normal * critical * in.approach_velocity);

    const Real damping = c.damping_tangential * critical * sqrt(c.tangential_ratio);
    limit_sliding(out, in, Real(c.tangential_ratio * k_n), damping, c.sliding * out.elastic_normal);
    return out;
  }

  static double normal_energy(const Coefficients& c, double /*effective_radius*/, double effective_mass,
                              double overlap) {
    return 0.5 * normal_stiffness(c, effective_mass) * overlap * overlap;
  }
  static double tangential_energy(const Coefficients& c, double /*effective_radius*/, double effective_mass,
                                  double /*overlap*/, double length) {
    return 0.5 * c.tangential_ratio * normal_stiffness(c, effective_mass) * length * length;
  }
};

}  // namespace wedge
