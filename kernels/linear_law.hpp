// linear_law.hpp: spring and dashpot in both directions with a Coulomb cap.
// Cundall & Strack (1979), Geotechnique 29, 47; stiffness from the contact time: Luding (2008), Granul. Matter 10,
// 235.
#pragma once

#include "kernels/contact_law.hpp"

namespace wedge {

struct LinearLaw {
  struct Coefficients {
    double stiffness;           // N/m, k_n when it is given
    double stiffness_per_mass;  // 1/s2, k_n / m* when the contact time is given: (pi^2 + ln^2 e) / t_c^2
    double tangential_ratio;    // k_t / k_n
    double sliding;             // mu_s
    double rolling;             // mu_r, m
    double damping_normal, damping_tangential;  // ratios of critical
    double lowest_normal;                       // N
  };

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

  static double normal_stiffness(const Coefficients& c, double effective_mass) {
    return c.stiffness + c.stiffness_per_mass * effective_mass;
  }

  static void remove_friction(Coefficients& c) { c.sliding = c.rolling = 0; }

  static ContactResponse respond(const Coefficients& c, const ContactInput& in) {
    ContactResponse out;
    const double k_n = normal_stiffness(c, in.effective_mass);
    const double critical = 2 * std::sqrt(in.effective_mass * k_n);
    out.elastic_normal = k_n * in.overlap;
    out.normal = std::max(c.lowest_normal, out.elastic_normal + c.damping_normal * critical * in.approach_velocity);

    const double k_t = c.tangential_ratio * k_n;
    const double damping = c.damping_tangential * critical * std::sqrt(c.tangential_ratio);
    const double cap = c.sliding * out.elastic_normal;
    const double length = std::sqrt(dot(in.displacement, in.displacement));
    const double elastic = k_t * length;
    const bool slides = elastic > cap;
    const double keep = slides ? cap / (elastic + tiny) : 1.0;
    out.displacement = keep * in.displacement;
    out.elastic_tangential = (-k_t * keep) * in.displacement;
    out.tangential = out.elastic_tangential - (slides ? 0.0 : damping) * in.tangential_velocity;
    out.sliding_loss = cap * (1 - keep) * length;
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
