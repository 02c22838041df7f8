// pair_mix.hpp: radii, masses and coefficients of the pairs in a slab of rows: constants where all grains are
// alike.
#pragma once

#include "core/state.hpp"
#include "kernels/slab.hpp"

namespace wedge {

/// What a law needs to know about a pack of pairs beside their motion.
template <class Coefficients>
struct PackOfPairs {
  Pack radius_first, radius_second, effective_radius, effective_mass;
  Coefficients coefficients;
};

/// All grains alike: one radius, one material. Everything about a pair is a constant of the loop.
template <class Law>
struct UniformMix {
  static constexpr bool alike = true;
  using Coefficients = typename Law::Coefficients;
  double radius, mass;
  Coefficients coefficients;

  WEDGE_INLINE PackOfPairs<Coefficients> pairs(const SeenSlab&, Index) const {
    return {Pack(radius), Pack(radius), Pack(0.5 * radius), Pack(0.5 * mass), coefficients};
  }
};

/// Any radii and materials: looked up for each pair.
template <class Law>
struct GeneralMix {
  static constexpr bool alike = false;
  using Coefficients = typename Law::Coefficients;
  using PackCoefficients = typename Law::template CoefficientsOf<Pack>;
  const Coefficients* table;  // by PairTable slot

  WEDGE_INLINE PackOfPairs<PackCoefficients> pairs(const SeenSlab& s, Index row) const {
    const Pack ri = s.radius_first.load(row), rj = s.radius_second.load(row);
    const Pack mi = s.mass_first.load(row), mj = s.mass_second.load(row);
    const auto get = [&](double Coefficients::*member) {
      return Pack([&](auto lane) { return table[s.materials[row + static_cast<Index>(lane)]].*member; });
    };
    return {ri, rj, ri * rj / (ri + rj), mi * mj / (mi + mj), PackCoefficients::from(get)};
  }
};

}  // namespace wedge
