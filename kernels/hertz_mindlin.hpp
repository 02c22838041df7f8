// hertz_mindlin.hpp: Hertz normal force, no-slip Mindlin stiffness, Coulomb cap, damping from a restitution: the
// form most open codes use. Mindlin (1949), J. Appl. Mech. 16, 259; damping as in core/restitution.hpp.
#pragma once

#include "kernels/contact_law.hpp"

namespace wedge {

struct HertzMindlin {
  struct Coefficients {
    double young;                               // E*, Pa
    double shear;                               // G*, Pa
    double sliding;                             // mu_s
    double rolling;                             // mu_r, m
    double damping_normal, damping_tangential;  // ratios of critical
    double lowest_normal;                       // N
  };

  static Coefficients prepare(const Material& a, const Material& b, const Interaction& c,
                              const ContactModel& model) {
    const double c_n =
        c.restitution ? damping_for(ContactLaw::hertz_mindlin, model.tension, *c.restitution) : c.damping_normal;
    const double c_t = c.restitution ? c_n : c.damping_tangential;
    return {effective_young(a, b),       effective_shear(a, b), c.sliding, c.rolling, c_n, c_t,
            lowest_normal(model.tension)};
  }

  static void remove_friction(Coefficients& c) { c.sliding = c.rolling = 0; }

  static ContactResponse respond(const Coefficients& c, const ContactInput& in) {
    ContactResponse out;
    const double root = std::sqrt(in.effective_radius * in.overlap);
    const double normal_stiffness = 2 * c.young * root;  // tangent: d f_cn / d dn
    out.elastic_normal = (2.0 / 3.0) * normal_stiffness * in.overlap;
    const double normal_damping = 2 * c.damping_normal * std::sqrt(in.effective_mass * normal_stiffness);
    out.normal = std::max(c.lowest_normal, out.elastic_normal + normal_damping * in.approach_velocity);

    const double stiffness = 8 * c.shear * root;
    const double damping = 2 * c.damping_tangential * std::sqrt(in.effective_mass * stiffness);
    const double cap = c.sliding * out.elastic_normal;
    const double length = std::sqrt(dot(in.displacement, in.displacement));
    const double elastic = stiffness * length;
    const bool slides = elastic > cap;
    const double keep = slides ? cap / (elastic + tiny) : 1.0;
    out.displacement = keep * in.displacement;
    out.elastic_tangential = (-stiffness * keep) * in.displacement;
    out.tangential = out.elastic_tangential - (slides ? 0.0 : damping) * in.tangential_velocity;
    out.sliding_loss = cap * (1 - keep) * length;
    return out;
  }

  static double normal_energy(const Coefficients& c, double effective_radius, double /*effective_mass*/,
                              double overlap) {
    return (8.0 / 15.0) * c.young * std::sqrt(effective_radius * overlap) * overlap * overlap;
  }
  static double tangential_energy(const Coefficients& c, double effective_radius, double /*effective_mass*/,
                                  double overlap, double length) {
    return 4 * c.shear * std::sqrt(effective_radius * overlap) * length * length;
  }
};

}  // namespace wedge
