// reduce_forces.hpp: each grain sums its contact rows in a fixed order; forces on images go back to their owners.
#pragma once

#include "kernels/evaluate_contacts.hpp"
#include "kernels/integrate.hpp"

namespace wedge {

/// Pre: evaluate_contacts wrote all rows. Post: force, torque and rolling_cap of every grain are the sums of its own
/// rows, ascending, and then of the rows in which it is `second`, ascending. Images are not yet folded back.
template <Friction friction, class Bodies>
void reduce_forces(const Bodies& bodies, State& state) {
  Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  for_each(p.count(), [&, bodies](Index i) {
    const auto s = static_cast<std::size_t>(i);
    const double radius = bodies.radius(i);
    Vec3 force, torque;
    double cap = 0;
    for (Index k = c.row_begin[s]; k < c.row_begin[s + 1]; ++k) {
      const auto r = static_cast<std::size_t>(k);
      force += c.force.get(r);
      if constexpr (friction != Friction::none) torque += (radius - c.half_overlap[r]) * c.lever_torque.get(r);
      if constexpr (friction == Friction::rolling) cap += c.rolling_cap[r];
    }
    for (Index m = c.incoming_begin[s]; m < c.incoming_begin[s + 1]; ++m) {
      const auto r = static_cast<std::size_t>(c.incoming[static_cast<std::size_t>(m)]);
      force -= c.force.get(r);
      if constexpr (friction != Friction::none) torque += (radius - c.half_overlap[r]) * c.lever_torque.get(r);
      if constexpr (friction == Friction::rolling) cap += c.rolling_cap[r];
    }
    p.force.set(s, force);
    if constexpr (friction != Friction::none) p.torque.set(s, torque);
    if constexpr (friction == Friction::rolling) p.rolling_cap[s] = cap;
  });
}

/// Adds to each grain what its images feel, turned back: by owner, images ascending.
/// Pre: reduce_forces ran. Post: force, torque and rolling_cap of the grains are complete but for walls.
template <Friction friction, class Bodies>
void fold_images(const Bodies& bodies, State& state) {
  Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  const ImageMap& images = state.images;
  const Index n = p.count();
  for_each(images.count(), [&, bodies](Index first) {
    const Index owner = images.owner[static_cast<std::size_t>(first)];
    if (first > 0 && images.owner[static_cast<std::size_t>(first - 1)] == owner) return;  // a sibling does it
    const auto o = static_cast<std::size_t>(owner);
    const double radius = bodies.radius(owner);
    Vec3 force = p.force.get(o), torque = p.torque.get(o);
    double cap = p.rolling_cap[o];
    for (Index m = first; m < images.count() && images.owner[static_cast<std::size_t>(m)] == owner; ++m) {
      const auto s = static_cast<std::size_t>(n + m);
      Vec3 image_force, image_torque;
      for (Index q = c.incoming_begin[s]; q < c.incoming_begin[s + 1]; ++q) {
        const auto r = static_cast<std::size_t>(c.incoming[static_cast<std::size_t>(q)]);
        image_force -= c.force.get(r);
        if constexpr (friction != Friction::none) image_torque += (radius - c.half_overlap[r]) * c.lever_torque.get(r);
        if constexpr (friction == Friction::rolling) cap += c.rolling_cap[r];
      }
      const int back = -images.turn[static_cast<std::size_t>(m)];
      force += state.symmetry.turn_vector(image_force, back);
      if constexpr (friction != Friction::none) torque += state.symmetry.turn_vector(image_torque, back);
    }
    p.force.set(o, force);
    if constexpr (friction != Friction::none) p.torque.set(o, torque);
    if constexpr (friction == Friction::rolling) p.rolling_cap[o] = cap;
  });
}

}  // namespace wedge
