// hertz_mindlin.hpp: Hertz normal force, no-slip Mindlin stiffness, Coulomb cap, damping from a restitution: the
// form most open codes use. Mindlin (1949), J. Appl. Mech. 16, 259; damping as in core/restitution.hpp.
#pragma once

#include "kernels/laws/contact_law.hpp"

namespace wedge {

struct HertzMindlin {
  template <class Real>
  struct CoefficientsOf {
    Real young;               // E*, Pa
    Real shear;               // G*, Pa
    Real sliding;             // mu_s
    Real rolling;             // mu_r, m
    Real damping_normal;      // ratio of critical
    Real damping_tangential;  // ratio of critical
    Real lowest_normal;       // N

    /// Each coefficient from `get`, called with the member of Coefficients.
    template <class Get>
    static CoefficientsOf from(Get&& get) {
      using One = CoefficientsOf<double>;
      return {get(&One::young),        get(&One::shear),          get(&One::sliding),
              get(&One::rolling),      get(&One::damping_normal), get(&One::damping_tangential),
              get(&One::lowest_normal)};
    }
  };
  using Coefficients = CoefficientsOf<double>;

  static Coefficients prepare(const Material& a, const Material& b, const Interaction& c,
                              const ContactModel& model) {
    const double c_n =
        c.restitution ? damping_for(ContactLaw::hertz_mindlin, model.tension, *c.restitution) : c.damping_normal;
    const double c_t = c.restitution ? c_n : c.damping_tangential;
    return {effective_young(a, b),       effective_shear(a, b), c.sliding, c.rolling, c_n, c_t,
            lowest_normal(model.tension)};
  }

  static void remove_friction(Coefficients& c) { c.sliding = c.rolling = 0; }

  template <class Number, class Real>
  WEDGE_INLINE static ContactResponseOf<Real> respond(const CoefficientsOf<Number>& c,
                                                      const ContactInputOf<Real>& in) {
    using std::max, std::sqrt;
    ContactResponseOf<Real> out;
    const Real root = sqrt(in.effective_radius * in.overlap);
    const Real normal_stiffness = 2 * c.young * root;  // tangent: d f_cn / d dn
    out.elastic_normal = constant<Real>(2.0 / 3.0) * normal_stiffness * in.overlap;
    const Real normal_damping = 2 * c.damping_normal * sqrt(in.effective_mass * normal_stiffness);
    out.normal = max(Real(c.lowest_normal), out.elastic_normal + normal_damping * in.approach_velocity);

    const Real stiffness = 8 * c.shear * root;
    const Real damping = 2 * c.damping_tangential * sqrt(in.effective_mass * stiffness);
    limit_sliding(out, in, stiffness, damping, c.sliding * out.elastic_normal);
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
