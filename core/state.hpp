// state.hpp: everything a simulation is at one moment, between two steps.
#pragma once

#include <cstdint>

#include "core/contact_table.hpp"
#include "core/image_map.hpp"
#include "core/particles.hpp"
#include "core/symmetry.hpp"
#include "core/vessel.hpp"

namespace wedge {

/// Energies booked since the start [J], of the domain (a sector's are those of one sector).
/// Balance: kinetic + rotational + elastic + potential now = the same at the start + carried_in - carried_out
/// + wall_work + history_coupling - the dissipated ones + residual.
struct EnergyLedger {
  double normal_damping = 0;      // dissipated
  double tangential_damping = 0;  // dissipated
  double sliding = 0;             // dissipated
  double rolling = 0;             // dissipated
  double axis = 0;                // dissipated by what the axis does to velocities
  double tangential_work = 0;     // done against the elastic tangential forces, sliding included
  double wall_work = 0;           // done by moving walls on the grains
  double carried_in = 0;          // energy of grains when they were put in after the start
  double carried_out = 0;         // energy of grains that left, of their contacts and those with removed walls
  double elastic_tangential_removed = 0;  // elastic tangential energy of contacts removed with their grain

  template <class Self, class Visit>
  static void for_each_field(Self& e, Visit&& visit) {
    visit("normal_damping", e.normal_damping);
    visit("tangential_damping", e.tangential_damping);
    visit("sliding", e.sliding);
    visit("rolling", e.rolling);
    visit("axis", e.axis);
    visit("tangential_work", e.tangential_work);
    visit("wall_work", e.wall_work);
    visit("carried_in", e.carried_in);
    visit("carried_out", e.carried_out);
    visit("elastic_tangential_removed", e.elastic_tangential_removed);
  }
};

struct State {
  /// How many grains of the whole vessel a grain of the domain stands for. Every extensive sum (grains, mass, load,
  /// rate) of the vessel counts each grain by it.
  double weight(Index) const { return copies; }

  Symmetry symmetry = Symmetry::none();
  Vessel vessel;
  Particles particles;
  ImageMap images;
  ContactTable contacts;
  WallContactTable wall_contacts;
  EnergyLedger energy;

  double time = 0;               // s
  std::int64_t step = 0;         // steps done
  double history_ahead = 0;      // s: stored displacements are this far ahead (kernels/README.md)
  double wall_margin = 0;        // m: how far a moving wall may go before the neighbour list is stale
  double wall_travel = 0;        // m: how far the fastest wall has gone since the list was made
  std::int64_t list_builds = 0;  // neighbour lists made so far
  bool list_expired = false;     // the next step makes the list anew, whatever has moved
  double mean_diameter = 0;      // m, of the grains at the start
  double copies = 1;             // of the domain that make the whole vessel, also where its sides are solid
  bool alike = false;            // all grains at the start had one radius and one material
  std::int64_t put_in = 0;       // grains put in since the start
  std::int64_t taken_out = 0;    // grains discharged since the start
  std::int64_t next_id = 0;      // above the ids of all grains that ever were
};

/// Symmetry, vessel and copies of a scene, no grains.
State make_domain(const Scene& scene);

/// The grain that the second of a row is or copies, and the turn at which the first sees it (0: in the domain).
struct Partner {
  Index grain;
  std::int32_t turn;
};
inline Partner row_partner(const State& state, std::size_t row) {
  const Index second = state.contacts.second[row], image = second - state.particles.count();
  if (image < 0) return {second, 0};
  return {state.images.owner[static_cast<std::size_t>(image)], state.images.turn[static_cast<std::size_t>(image)]};
}
/// Whether the contact of the row is seen from both its ends.
inline bool row_is_shared(const State& state, std::size_t row) {
  const Partner partner = row_partner(state, row);
  return state.symmetry.is_seen_from_both_ends(state.contacts.first[row], partner.grain, partner.turn);
}

/// Way from the first grain of a row to the second [m], at the places where they are now.
inline Vec3 row_way(const State& state, std::size_t row) {
  const Vec3Array& x = state.particles.position;
  return x.get(static_cast<std::size_t>(state.contacts.second[row])) -
         x.get(static_cast<std::size_t>(state.contacts.first[row]));
}
/// Unit vector from the first grain of a row to the second.
inline Vec3 row_normal(const State& state, std::size_t row) {
  const Vec3 way = row_way(state, row);
  return (1 / norm(way)) * way;
}
/// Overlap of the two grains of a row [m]; negative while they are apart.
inline double row_overlap(const State& state, std::size_t row) {
  const Array<double>& radius = state.particles.radius;
  return radius[static_cast<std::size_t>(state.contacts.first[row])] +
         radius[static_cast<std::size_t>(state.contacts.second[row])] - norm(row_way(state, row));
}

}  // namespace wedge
