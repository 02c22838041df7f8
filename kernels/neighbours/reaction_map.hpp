// reaction_map.hpp: where the forces of contact rows go: an index map, made with each neighbour list.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"

namespace wedge {

/// Grains whose rows are computed together, by one thread, which adds their forces as it goes. Sorted grains make a
/// tile compact, so that its grains and sums stay in the second-level cache; fixed, so that results do not depend
/// on the number of threads.
inline constexpr Index tile_size = 1024;
static_assert(tile_size % block_size == 0, "a tile is made of whole blocks");
inline Index tile_count(Index grains) { return (grains + tile_size - 1) / tile_size; }

/// Sums of forces are numbered: grains first, then the guests of each tile. A tile adds to the sums of its own
/// grains and to sums of its own for what it does to others, its guests (grains of other tiles, and images). Those
/// are folded back afterwards (kernels/passes/force_sums.hpp).
struct ReactionMap {
  /// Sums of grains and guests.
  Index sums() const { return guests_begin.empty() ? 0 : guests_begin.back(); }

  Array<Index> target;        // per row: the sum for what its `second` feels
  Array<Index> guests_begin;  // per tile: its first guest sum; one entry more than there are tiles
  // What is folded back: to receiver[r] go the sums source[source_begin[r]] .. source[source_begin[r+1]-1],
  // ascending, each turned by source_turn.
  Array<Index> receiver, source_begin, source;
  Array<std::int32_t> source_turn;

  std::int64_t list = -1;  // number of the neighbour list that the map was made for
};

/// Pre: the contact list is new. Post: `map` fits it. A row without a reaction (a grain and its own copy half a
/// turn away: the reaction is the same contact seen again; a contact of a grain held on the axis with a copy) has a
/// sum that nobody reads.
void map_reactions(const State& state, AxisRule axis, ReactionMap& map);

}  // namespace wedge
