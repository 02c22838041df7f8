// bed.hpp: grains at one moment as measuring sees them: in cylinder axes, with their contacts, and who is in the
// bed.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/measure/measured_domain.hpp"
#include "core/state.hpp"
#include "io/files/frame.hpp"

namespace wedge {

/// A grain. Vectors are components along the radius, the azimuth and z; of a slot along x, y, z.
struct BedGrain {
  Vec3 position;             // m, x y z
  double r = 0;              // m from the axis; of a slot abs(x)
  double azimuth = 0;        // rad, in [0, 2 pi); of a slot 0
  double radius = 0;         // m
  double mass = 0;           // kg
  double weight = 1;         // grains of the whole vessel that it stands for
  Vec3 velocity;             // m/s, (vr, vt, vz)
  Vec3 normal_force;         // N, (fr, ft, fz): sum of the normal forces of contacts with grains
  std::int32_t cn = 0;       // contacts with grains
  std::int32_t cn_near = 0;  // grains with a gap below near_gap
  std::int32_t cn_distinct = 0;
  std::int32_t layer = 0;
  bool in_bed = false, in_bulk = false;
};

/// A contact of two grains, seen from the first one; the second may be an image.
struct BedContact {
  Index first = 0, second = 0;  // places among the grains
  int turn = 0;                 // of the second
  Vec3 from, to;                // m, centres
  Vec3 force;                   // N, on the first
  double load = 0;              // N, normal force, positive when they push
};

/// Of the domain of a run.
struct Bed {
  std::vector<BedGrain> grains;
  std::vector<BedContact> contacts;
  bool has_forces = false;             // of the contacts; else they are overlaps, without forces
  bool has_near = false;               // near neighbours were counted
  double ground = 0;                   // m: the bed is what has its centre above
  double bulk_low = 0, bulk_high = 0;  // m, quantiles of height
};

/// Neighbours count as near below this gap, in mean diameters.
inline constexpr double near_gap = 0.005;

/// Height [m] of what the bed stands on: the highest wall, of those present, that reaches the axis below the
/// grains' median height, else the lowest wall.
double ground_height(const MeasuredDomain& domain, const Vessel& vessel, const Particles& grains);

/// The bed of a run between two steps. Contacts are the overlaps of its own list, without forces; near neighbours,
/// for which that list may be too short, are not counted.
Bed bed_of_run(const MeasuredDomain& domain, const State& state);
/// The bed of a frame. `state` has its grains and the walls of its moment, but no contacts; those are the overlaps
/// where `contacts` is null.
Bed bed_of_frame(const MeasuredDomain& domain, const State& state, const ContactFrame* contacts);

}  // namespace wedge
