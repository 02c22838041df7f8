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
  double axis = 0;                // dissipated by the axis rule `clamp`
  double tangential_work = 0;     // done against the elastic tangential forces, sliding included
  double wall_work = 0;           // done by moving walls on the grains
  double carried_in = 0;          // energy of grains when they entered
  double carried_out = 0;         // energy of grains, and of their contacts, when they left
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
  Symmetry symmetry = Symmetry::none();
  Vessel vessel;
  Particles particles;
  ImageMap images;
  ContactTable contacts;
  WallContactTable wall_contacts;
  EnergyLedger energy;

  double time = 0;             // s
  std::int64_t step = 0;       // steps done
  double skin = 0;             // m: pairs closer than the sum of radii + skin are in the list
  double wall_travel = 0;      // m: upper bound of the way of a moving wall since the list was made
  std::int64_t list_builds = 0;  // neighbour lists made so far
  std::int64_t put_in = 0;       // grains put in since the start
  std::int64_t taken_out = 0;    // grains discharged since the start
};

}  // namespace wedge
