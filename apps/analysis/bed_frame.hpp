// bed_frame.hpp: one frame as analysis sees it: grains in cylinder axes with their contacts, and who is in the bed.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/analysis/analysed_run.hpp"
#include "io/files/frame.hpp"

namespace wedge {

/// A grain. Vectors are components along the radius, the azimuth and z; of a slot along x, y, z.
struct BedGrain {
  Vec3 position;             // m, x y z
  double r = 0;              // m from the axis; of a slot abs(x)
  double azimuth = 0;        // rad, in [0, 2 pi); of a slot 0
  double radius = 0;         // m
  double mass = 0;           // kg
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

struct BedFrame {
  double time = 0;  // s
  std::vector<BedGrain> grains;
  std::vector<BedContact> contacts;
  bool has_forces = false;  // contacts of a frame of contacts; else contacts are overlaps, without forces
  double ground = 0;        // m: the bed is what has its centre above
  double bulk_low = 0, bulk_high = 0;  // m, quantiles of height
};

/// Neighbours count as near below this gap, in mean diameters.
inline constexpr double near_gap = 0.005;

/// Height [m] of what the bed stands on: the highest wall, of those present, that reaches the axis below the
/// grains' median height, else the lowest wall.
double ground_height(const AnalysedRun& run, const Vessel& vessel, const Particles& grains);

/// Reads frame `number` with its contacts, if there are any. Throws FileError.
BedFrame read_bed_frame(const AnalysedRun& run, std::int64_t number);
/// The same of a frame in memory; `contacts` may be null. `vessel` has the walls of that moment.
BedFrame make_bed_frame(const AnalysedRun& run, const Vessel& vessel, const ParticleFrame& frame,
                        const ContactFrame* contacts);

}  // namespace wedge
