// mindlin_deresiewicz.hpp: the default law: Hertz, viscous damping, Mindlin-Deresiewicz friction with its stored
// displacement. Zhou, Xu, Yu, Zulli (2002), Powder Technol. 125, 45; Yang et al. (2014), Ind. Eng. Chem. Res. 53,
// 8245.
#pragma once

#include "kernels/laws/contact_law.hpp"

namespace wedge {

struct MindlinDeresiewicz {
  template <class Real>
  struct CoefficientsOf {
    Real young;                       // E*, Pa
    Real sliding;                     // mu_s
    Real rolling;                     // mu_r, m
    Real limit;                       // dt_max / dn = mu_s E* / (4 G*)
    Real damping_normal;              // c_n
    Real damping_tangential_squared;  // 6 c_t^2 (4/3) E* mu_s dn / dt_max, Pa: what is constant under the root
    Real lowest_normal;               // N

    /// Each coefficient from `get`, called with the member of Coefficients.
    template <class Get>
    static CoefficientsOf from(Get&& get) {
      using One = CoefficientsOf<double>;
      return {get(&One::young),        get(&One::sliding),        get(&One::rolling),
              get(&One::limit),        get(&One::damping_normal), get(&One::damping_tangential_squared),
              get(&One::lowest_normal)};
    }
  };
  using Coefficients = CoefficientsOf<double>;

  static Coefficients prepare(const Material& a, const Material& b, const Interaction& c,
                              const ContactModel& model) {
    const double young = effective_young(a, b);
    // dt_max / (mu_s dn); the damping needs mu_s / limit, which is 1 / slope and stays finite without friction
    const double slope = young / (4 * effective_shear(a, b));
    const double c_n = c.restitution ? damping_for(ContactLaw::mindlin_deresiewicz, model.tension, *c.restitution)
                                     : c.damping_normal;
    const double c_t = c.restitution ? c_n : c.damping_tangential;
    return {young,
            c.sliding,
            c.rolling,
            c.sliding * slope,
            c_n,
            c.sliding > 0 ? 6 * c_t * c_t * (4.0 / 3.0) * young / slope : 0,
            lowest_normal(model.tension)};
  }

  static void remove_friction(Coefficients& c) {
    c.sliding = c.rolling = c.limit = c.damping_tangential_squared = 0;
  }

  template <class Number, class Real>
  WEDGE_INLINE static ContactResponseOf<Real> respond(const CoefficientsOf<Number>& c,
                                                      const ContactInputOf<Real>& in) {
    using std::max, std::min, std::sqrt;
    ContactResponseOf<Real> out;
    const Real root = sqrt(in.effective_radius * in.overlap);
    out.elastic_normal = constant<Real>(4.0 / 3.0) * c.young * root * in.overlap;
    const Real damping = c.damping_normal * sqrt(8 * in.effective_mass * c.young * root);
    out.normal = max(Real(c.lowest_normal), out.elastic_normal + damping * in.approach_velocity);

    const Real length_squared = dot(in.displacement, in.displacement);
    const Real inverse_length = 1 / sqrt(length_squared + tiny<Real>);
    const Real length = length_squared * inverse_length;
    const Real length_max = c.limit * in.overlap;
    const Real left = max(Real(0), 1 - length / (length_max + tiny<Real>));  // 1 - dt/dt_max
    const Real left_root = sqrt(left);
    const Real keep = min(Real(1), length_max * inverse_length);  // cut back to dt_max
    const Real cap = c.sliding * out.elastic_normal;
    const Real elastic = cap * (1 - left * left_root);
    const Real viscous = sqrt(c.damping_tangential_squared * in.effective_mass * root * left_root);
    out.displacement = keep * in.displacement;
    out.elastic_tangential = (-elastic * inverse_length) * in.displacement;
    out.tangential = out.elastic_tangential - viscous * in.tangential_velocity;
    out.sliding_loss = cap * (1 - keep) * length;
    return out;
  }

  /// Elastic energy [J] of the normal part at an overlap.
  static double normal_energy(const Coefficients& c, double effective_radius, double /*effective_mass*/,
                              double overlap) {
    return (8.0 / 15.0) * c.young * std::sqrt(effective_radius * overlap) * overlap * overlap;
  }
  /// Elastic energy [J] of the tangential part at a displacement of length `length`.
  static double tangential_energy(const Coefficients& c, double effective_radius, double /*effective_mass*/,
                                  double overlap, double length) {
    const double limit = c.limit * overlap;
    const double load = c.sliding * (4.0 / 3.0) * c.young * std::sqrt(effective_radius * overlap) * overlap;
    const double s = std::min(length, limit);
    const double left = 1 - s / (limit + tiny<double>);
    return load * (s - (2.0 / 5.0) * limit * (1 - left * left * std::sqrt(left)));
  }
};

}  // namespace wedge
