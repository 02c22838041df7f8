// reduce_forces.hpp: each grain sums its contact rows in a fixed order; forces on images go back to their owners.
#pragma once

#include "kernels/evaluate_contacts.hpp"
#include "kernels/integrate.hpp"

namespace wedge {

/// Incoming rows lie far apart in memory: each is asked for this many rows before it is needed.
inline constexpr Index prefetch_distance = 24;

/// What a grain or an image feels: sums of row outcomes.
struct Felt {
  Vec3 force, torque;
  double cap = 0;

  /// Adds row r; `sign` is +1 for the first grain of the row, -1 for the second. A lever torque is the same for
  /// both.
  template <Friction friction>
  void add(const ContactTable& c, Index row, double sign, double radius) {
    const auto r = static_cast<std::size_t>(row);
    force += sign * c.force(r);
    if constexpr (friction != Friction::none) torque += (radius - c.half_overlap(r)) * c.lever_torque(r);
    if constexpr (friction == Friction::rolling) cap += c.rolling_cap(r);
    if constexpr (has_couples(friction)) torque += sign * c.couple.get(r);
  }
  /// Adds the rows in which `slot` is second, ascending.
  template <Friction friction>
  void add_incoming(const ContactTable& c, std::size_t slot, double radius) {
    const Index last = static_cast<Index>(c.incoming.size()) - 1;
    for (Index m = c.incoming_begin[slot]; m < c.incoming_begin[slot + 1]; ++m) {
      const Index soon = c.incoming[static_cast<std::size_t>(std::min(m + prefetch_distance, last))];
      __builtin_prefetch(c.outcome.data() + ContactTable::outcome_size * static_cast<std::size_t>(soon));
      add<friction>(c, c.incoming[static_cast<std::size_t>(m)], -1, radius);
    }
  }
};

/// Pre: evaluate_contacts wrote all rows. Post: force, torque and rolling_cap of every grain are the sums of its
/// own rows, ascending, and then of the rows in which it is `second`, ascending. Images are not yet folded back.
template <Friction friction, class Bodies>
void reduce_forces(const Bodies& bodies, State& state) {
  Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  for_each(p.count(), [&, bodies](Index i) {
    const auto s = static_cast<std::size_t>(i);
    const double radius = bodies.radius(i);
    Felt felt;
    for (Index k = c.row_begin[s]; k < c.row_begin[s + 1]; ++k) felt.add<friction>(c, k, +1, radius);
    felt.add_incoming<friction>(c, s, radius);
    p.force.set(s, felt.force);
    if constexpr (friction != Friction::none) p.torque.set(s, felt.torque);
    if constexpr (friction == Friction::rolling) p.rolling_cap[s] = felt.cap;
  });
}

/// Adds to each grain what its images feel, turned back: by owner, images ascending.
/// Pre: reduce_forces ran. Post: force, torque and rolling_cap of the grains are complete but for walls.
template <Friction friction, class Bodies>
void fold_images(const Bodies& bodies, State& state) {
  Particles& p = state.particles;
  const ImageMap& images = state.images;
  const auto n = static_cast<std::size_t>(p.count());
  for_each(images.count(), [&, bodies](Index first) {
    const Index owner = images.owner[static_cast<std::size_t>(first)];
    if (first > 0 && images.owner[static_cast<std::size_t>(first - 1)] == owner) return;  // a sibling does it
    const auto o = static_cast<std::size_t>(owner);
    Felt sum{p.force.get(o), p.torque.get(o), p.rolling_cap[o]};
    for (auto m = static_cast<std::size_t>(first); m < images.owner.size() && images.owner[m] == owner; ++m) {
      Felt felt;
      felt.add_incoming<friction>(state.contacts, n + m, bodies.radius(owner));
      const int back = -images.turn[m];
      sum.force += state.symmetry.turn_vector(felt.force, back);
      if constexpr (friction != Friction::none) sum.torque += state.symmetry.turn_vector(felt.torque, back);
      if constexpr (friction == Friction::rolling) sum.cap += felt.cap;
    }
    p.force.set(o, sum.force);
    if constexpr (friction != Friction::none) p.torque.set(o, sum.torque);
    if constexpr (friction == Friction::rolling) p.rolling_cap[o] = sum.cap;
  });
}

}  // namespace wedge
