// force_sums.cpp: the pass that folds the sums of guests back to the grains they are of.
#include "kernels/passes/force_sums.hpp"

#include <algorithm>

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Sums of guests lie anywhere: each is asked for this many before it is needed.
constexpr Index fetched_ahead = 16;

template <class Number>
void fold(const State& state, const ReactionMap& map, ForceSums& sums) {
  const auto last = static_cast<Index>(map.source.size()) - 1;
  for_each(static_cast<Index>(map.receiver.size()), [&](Index m) {
    Number* sum = sums.sum<Number>(map.receiver[at(m)]);
    const Index soon = std::min(map.source_begin[at(m)] + fetched_ahead, last);
    __builtin_prefetch(sums.sum<Number>(map.source[at(soon)]));
    for (std::size_t s = at(map.source_begin[at(m)]); s < at(map.source_begin[at(m) + 1]); ++s) {
      const Number* guest = sums.sum<Number>(map.source[s]);
      Vec3 force{guest[0], guest[1], guest[2]}, torque{guest[3], guest[4], guest[5]};
      if (map.source_turn[s] != 0) {
        force = state.symmetry.turn_vector(force, map.source_turn[s]);
        torque = state.symmetry.turn_vector(torque, map.source_turn[s]);
      }
      const double felt[] = {force.x, force.y, force.z, torque.x, torque.y, torque.z, guest[6]};
      for (int c = 0; c < 7; ++c) sum[c] += static_cast<Number>(felt[c]);
    }
  });
}

}  // namespace

void fold_reactions(const State& state, const ReactionMap& map, ForceSums& sums) {
  if (state.particles.seen.precision() == Precision::mixed)
    fold<float>(state, map, sums);
  else
    fold<double>(state, map, sums);
}

}  // namespace wedge
