// total_coulomb.hpp: any law with the option coulomb = "total": elastic and viscous tangential force together stay
// within mu_s |f_cn|.
#pragma once

#include "kernels/contact_law.hpp"

namespace wedge {

template <class Law>
struct TotalCoulomb : Law {
  static ContactResponse respond(const typename Law::Coefficients& c, const ContactInput& in) {
    ContactResponse out = Law::respond(c, in);
    const double limit = c.sliding * out.elastic_normal, size = norm(out.tangential);
    if (size > limit) out.tangential = (limit / size) * out.tangential;
    return out;
  }
};

}  // namespace wedge
