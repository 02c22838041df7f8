// contact_forces.hpp: the force of each contact at this moment, for whoever looks. The contact pass keeps none: it
// adds them up and lets them go.
#pragma once

#include "core/parallel.hpp"
#include "core/state.hpp"
#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/passes/contact_kinematics.hpp"

namespace wedge {

/// By this part a displacement is taken as longer than it is, so that a contact that slides, whose displacement was
/// cut back to the limit, is seen to slide in spite of round-off. (A dashpot sets in just below the limit.)
inline constexpr double sliding_margin = 1e-10;

/// Force on the first grain of each row [N] as it was in the last force step, from what that step left: places,
/// velocities seen, and displacements less the half step by which they are stored ahead. Zero for rows that do not
/// touch. Exact but for round-off and `sliding_margin`.
template <class Law>
Vec3Array contact_forces(const PairTable<typename Law::Coefficients>& table, Friction friction,
                         const State& state) {
  const Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  Vec3Array forces;
  forces.resize(c.first.size());
  for_each(c.rows(), [&](Index k) {
    const auto row = static_cast<std::size_t>(k);
    const auto first = static_cast<std::size_t>(c.first[row]), second = static_cast<std::size_t>(c.second[row]);
    const Seen i = p.seen.get(first), j = p.seen.get(second);
    const Vec3 d = j.position - i.position;
    const double distance = norm(d), overlap = std::max(0.0, i.radius + j.radius - distance);
    const Vec3 n = (1 / distance) * d;
    const Vec3 v = surface_velocity<false>(i.velocity - j.velocity, i.angular_velocity + j.angular_velocity,
                                           i.angular_velocity - j.angular_velocity, d, n, i.radius - j.radius);
    const ContactVelocity<double> velocity = along_and_across(v, n);
    ContactInput in{overlap, effective(i.radius, j.radius), effective(i.mass, j.mass), velocity.approach, {}, {}};
    in.tangential_velocity = velocity.tangential;
    in.displacement = (1 + sliding_margin) * (c.history.get(row) - state.history_ahead * in.tangential_velocity);
    if (friction == Friction::none) in.tangential_velocity = in.displacement = {};
    const ContactResponse out = Law::respond(table(p.material[first], p.material[second]), in);
    forces.set(row, overlap > 0 ? out.tangential - out.normal * n : Vec3{});
  });
  return forces;
}

}  // namespace wedge
