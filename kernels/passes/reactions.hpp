// reactions.hpp: where the forces of contact rows go: sums per grain, without atomics and in a fixed order.
#pragma once

#include "core/pack.hpp"
#include "core/parallel.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// Grains whose rows are computed together, by one thread, which adds their forces as it goes. Sorted grains make a
/// tile compact, so that its grains and sums stay in the second-level cache; fixed, so that results do not depend
/// on the number of threads.
inline constexpr Index tile_size = 1024;
static_assert(tile_size % block_size == 0, "a tile is made of whole blocks");
inline Index tile_count(Index grains) { return (grains + tile_size - 1) / tile_size; }

/// Sums of forces. A tile adds to the sums of its own grains and to sums of its own for what it does to others: its
/// guests (grains of other tiles, and images). Those are folded back afterwards, from an index map.
struct Reactions {
  /// A sum: force [N] (3), torque [N m] (3), mu_r |f_n| [N m], not used.
  static constexpr std::size_t sum_size = 8;
  /// Sum s, of the width of the work on contacts. Grains first, then the guests of each tile.
  /// Pre: Number is float where the precision is mixed, and double otherwise.
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
    return const_cast<Reactions*>(this)->sum<Number>(s);
  }
  double component(Index s, std::size_t c) const {
    return single_sums.empty() ? sum<double>(s)[c] : static_cast<double>(sum<float>(s)[c]);
  }
  Vec3 force(Index s) const { return {component(s, 0), component(s, 1), component(s, 2)}; }
  Vec3 torque(Index s) const { return {component(s, 3), component(s, 4), component(s, 5)}; }
  double rolling_cap(Index s) const { return component(s, 6); }
  Index count() const { return guests_begin.empty() ? 0 : guests_begin.back(); }
  Array<double> double_sums;  // one of the two is empty
  Array<float> single_sums;

  Array<Index> target;        // per row: the sum for what its `second` feels
  Array<Index> guests_begin;  // per tile: its first guest sum; one entry more than there are tiles
  // What is folded back: to receiver[r] go the sums source[source_begin[r]] .. source[source_begin[r+1]-1],
  // ascending, each turned by source_turn.
  Array<Index> receiver, source_begin, source;
  Array<std::int32_t> source_turn;

  std::int64_t list = -1;  // number of the neighbour list that the map was made for
};

/// Pre: the contact list is new. Post: `reactions` fits it. A row without a reaction (a grain and its own copy half
/// a turn away: the reaction is the same contact seen again; a contact of a grain pinned to the axis with a copy)
/// has a sum that nobody reads.
void map_reactions(const State& state, AxisRule axis, Reactions& reactions);

/// Adds to each grain what other tiles and its images feel for it, turned back. Pre: all tiles are done.
/// Post: the sums of the grains are complete but for walls.
void fold_reactions(const State& state, Reactions& reactions);

}  // namespace wedge
