// total_coulomb.hpp: any law with the option coulomb = "total": elastic and viscous tangential force together stay
// within mu_s |f_cn|.
#pragma once

#include "kernels/laws/contact_law.hpp"

namespace wedge {

template <class Law>
struct TotalCoulomb : Law {
  template <class Coefficients, class Real>
  WEDGE_INLINE static ContactResponseOf<Real> respond(const Coefficients& c, const ContactInputOf<Real>& in) {
    ContactResponseOf<Real> out = Law::respond(c, in);
    const Real limit = c.sliding * out.elastic_normal, size = norm(out.tangential);
    out.tangential = select(size > limit, limit / (size + tiny<Real>), Real(1)) * out.tangential;
    return out;
  }
};

}  // namespace wedge
