// pair_mix.hpp: radii, masses and coefficients of the pairs in a slab of rows: constants where grains are alike.
#pragma once

#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/passes/slab.hpp"

namespace wedge {

/// What a law needs to know about a pack of pairs beside their motion.
template <class Coefficients, class Real>
struct PackOfPairs {
  Real radius_first, radius_second, effective_radius, effective_mass;
  Coefficients coefficients;
};

/// Coefficients of a law in another width.
template <class Law, class Number>
typename Law::template CoefficientsOf<Number> coefficients_in(const typename Law::Coefficients& c) {
  return Law::template CoefficientsOf<Number>::from(
      [&](double Law::Coefficients::*member) { return static_cast<Number>(c.*member); });
}

/// All grains alike: one radius, one material. Everything about a pair is a constant of the loop.
template <class Law, class Number_>
struct UniformMix {
  using Number = Number_;
  using Real = PackOf<Number>;
  using Coefficients = typename Law::template CoefficientsOf<Number>;
  static constexpr bool alike = true;
  Number radius, mass;
  Coefficients coefficients;
  Number common_radius() const { return radius; }

  WEDGE_INLINE PackOfPairs<Coefficients, Real> pairs(const SeenSlab<Number>&, Index) const {
    return {Real(radius), Real(radius), Real(radius / 2), Real(mass / 2), coefficients};
  }
};

template <class Coefficients, class Number>
WEDGE_INLINE PackOfPairs<Coefficients, PackOf<Number>> pairs_of_sizes(const SeenSlab<Number>& s, Index row,
                                                                      const Coefficients& coefficients) {
  using Real = PackOf<Number>;
  const Real ri = s.radius_first.load(row), rj = s.radius_second.load(row);
  const Real mi = s.mass_first.load(row), mj = s.mass_second.load(row);
  return {ri, rj, effective(ri, rj), effective(mi, mj), coefficients};
}

/// Any radii, one material.
template <class Law, class Number_>
struct SizeMix {
  using Number = Number_;
  using Real = PackOf<Number>;
  using Coefficients = typename Law::template CoefficientsOf<Number>;
  static constexpr bool alike = false;
  Coefficients coefficients;
  Number common_radius() const { return 0; }

  WEDGE_INLINE PackOfPairs<Coefficients, Real> pairs(const SeenSlab<Number>& s, Index row) const {
    return pairs_of_sizes(s, row, coefficients);
  }
};

/// Any radii and materials: looked up for each pair.
template <class Law, class Number_>
struct GeneralMix {
  using Number = Number_;
  using Real = PackOf<Number>;
  using PackCoefficients = typename Law::template CoefficientsOf<Real>;
  static constexpr bool alike = false;
  const typename Law::Coefficients* table;  // by PairTable slot
  Number common_radius() const { return 0; }

  WEDGE_INLINE PackOfPairs<PackCoefficients, Real> pairs(const SeenSlab<Number>& s, Index row) const {
    const auto get = [&](double Law::Coefficients::*member) {
      return Real([&](auto lane) {
        return static_cast<Number>(table[s.materials[row + static_cast<Index>(lane)]].*member);
      });
    };
    return pairs_of_sizes(s, row, PackCoefficients::from(get));
  }
};

}  // namespace wedge
