// reaction_map.cpp: the index map from contact rows to sums of forces.
#include "kernels/neighbours/reaction_map.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include "core/axis.hpp"

namespace wedge {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Whether the second grain of row k feels the row.
bool has_reaction(const State& state, AxisRule axis, std::size_t k) {
  const ContactTable& c = state.contacts;
  const Particles& p = state.particles;
  const Index image = c.second[k] - p.count();
  if (image < 0) return true;
  const std::size_t i = at(c.first[k]);
  if (held_on_axis(axis, p.position.x[i], p.position.y[i], p.radius[i])) return false;
  return !row_is_shared(state, k);
}

/// The guests of one tile: slots, ascending. Its first sum belongs to none of them: it takes what nobody feels.
struct Guests {
  std::vector<Index> slots;
  Index sum_of(Index slot) const {  // within the tile's sums
    return 1 + static_cast<Index>(std::lower_bound(slots.begin(), slots.end(), slot) - slots.begin());
  }
};

Guests find_guests(const State& state, AxisRule axis, Index tile) {
  const ContactTable& c = state.contacts;
  const Index begin = tile * tile_size, end = std::min(state.particles.count(), begin + tile_size);
  Guests guests;
  for (std::size_t k = at(c.row_begin[at(begin)]); k < at(c.row_begin[at(end)]); ++k)
    if ((c.second[k] < begin || c.second[k] >= end) && has_reaction(state, axis, k))
      guests.slots.push_back(c.second[k]);
  std::sort(guests.slots.begin(), guests.slots.end());
  guests.slots.erase(std::unique(guests.slots.begin(), guests.slots.end()), guests.slots.end());
  return guests;
}

/// Lists for each grain the guest sums that are its own, ascending.
void list_sources(const State& state, const std::vector<Guests>& guests, ReactionMap& r) {
  const Index n = state.particles.count();
  const auto owner_of = [&](Index slot) { return slot < n ? slot : state.images.owner[at(slot - n)]; };
  std::vector<Index> place(at(n) + 1, 0);
  for (const Guests& g : guests)
    for (const Index slot : g.slots) ++place[at(owner_of(slot))];
  r.receiver.clear();
  r.source_begin.clear();
  Index sources = 0;
  for (Index i = 0; i < n; ++i) {
    const Index count = place[at(i)];
    place[at(i)] = sources;
    if (count == 0) continue;
    r.receiver.push_back(i);
    r.source_begin.push_back(sources);
    sources += count;
  }
  r.source_begin.push_back(sources);
  resize_anew(r.source, at(sources));
  resize_anew(r.source_turn, at(sources));
  for (std::size_t tile = 0; tile < guests.size(); ++tile) {
    for (const Index slot : guests[tile].slots) {
      const std::size_t s = at(place[at(owner_of(slot))]++);
      r.source[s] = r.guests_begin[tile] + guests[tile].sum_of(slot);
      r.source_turn[s] = slot < n ? 0 : -state.images.turn[at(slot - n)];
    }
  }
}

}  // namespace

void map_reactions(const State& state, AxisRule axis, ReactionMap& r) {
  const ContactTable& c = state.contacts;
  const Index n = state.particles.count(), tiles = tile_count(n);
  std::vector<Guests> guests(at(tiles));
  for_each_block(tiles, [&](Index tile) { guests[at(tile)] = find_guests(state, axis, tile); });
  r.guests_begin.assign(at(tiles) + 1, n);
  for (std::size_t tile = 0; tile < at(tiles); ++tile)
    r.guests_begin[tile + 1] = r.guests_begin[tile] + 1 + static_cast<Index>(guests[tile].slots.size());
  resize_anew(r.target, c.first.size());
  for_each_block(tiles, [&](Index tile) {
    const Index begin = tile * tile_size, end = std::min(n, begin + tile_size);
    for (std::size_t k = at(c.row_begin[at(begin)]); k < at(c.row_begin[at(end)]); ++k) {
      const Index slot = c.second[k];
      r.target[k] = !has_reaction(state, axis, k) ? r.guests_begin[at(tile)]
                    : slot >= begin && slot < end ? slot
                                                  : r.guests_begin[at(tile)] + guests[at(tile)].sum_of(slot);
    }
  });
  list_sources(state, guests, r);
  r.list = state.list_builds;
}

}  // namespace wedge
