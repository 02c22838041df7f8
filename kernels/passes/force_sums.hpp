// force_sums.hpp: sums of forces per grain, without atomics and in a fixed order.
#pragma once

#include "core/pack.hpp"
#include "core/precision.hpp"
#include "core/state.hpp"
#include "kernels/neighbours/reaction_map.hpp"

namespace wedge {

/// The sums that a ReactionMap numbers.
struct ForceSums {
  /// A sum: force [N] (3), torque [N m] (3), mu_r |f_n| [N m], not used.
  static constexpr std::size_t sum_size = 8;

  /// Post: there is room for `sums` sums of the width of the work on contacts; what they hold is not said.
  void fit(Index sums, Precision precision) {
    const std::size_t numbers = sum_size * static_cast<std::size_t>(sums);
    const bool mixed = precision == Precision::mixed;
    resize_anew(double_sums, mixed ? 0 : numbers);
    resize_anew(single_sums, mixed ? numbers : 0);
  }
  /// Sum s. Pre: Number is float where the precision is mixed, and double otherwise.
  template <class Number>
  Number* sum(Index s) {
    const std::size_t first = sum_size * static_cast<std::size_t>(s);
    if constexpr (std::is_same_v<Number, float>)
      return single_sums.data() + first;
    else
      return double_sums.data() + first;
  }
  template <class Number>
  const Number* sum(Index s) const {
    return const_cast<ForceSums*>(this)->sum<Number>(s);
  }
  bool narrow() const { return !single_sums.empty(); }
  double component(Index s, std::size_t c) const {
    return narrow() ? static_cast<double>(sum<float>(s)[c]) : sum<double>(s)[c];
  }
  Vec3 force(Index s) const { return {component(s, 0), component(s, 1), component(s, 2)}; }
  Vec3 torque(Index s) const { return {component(s, 3), component(s, 4), component(s, 5)}; }
  double rolling_cap(Index s) const { return component(s, 6); }

  Array<double> double_sums;  // one of the two is empty
  Array<float> single_sums;
};

/// Adds to each grain what other tiles and its images feel for it, turned back. Pre: all tiles are done.
/// Post: the sums of the grains are complete but for walls.
void fold_reactions(const State& state, const ReactionMap& map, ForceSums& sums);

}  // namespace wedge
