// particles.hpp: the grains, as a structure of arrays, and the one list of their fields.
//
// Slots 0 .. count()-1 are the grains of the domain. Slots count() .. count()+images-1 of `position`, `seen`,
// `radius`, `mass` and `material` are images of grains across a periodic face (see image_map.hpp); all other fields
// hold grains alone.
#pragma once

#include <cstdint>

#include "core/pack.hpp"
#include "core/seen.hpp"

namespace wedge {

/// What a field is, for whoever writes it to a file.
struct FieldInfo {
  const char* name;     // as written in files
  const char* unit;     // SI, "" for a plain number
  const char* meaning;  // one line for the reader of the file
};

struct Particles {
  // State: all of one time between steps.
  Vec3Array position;          // m
  Vec3Array velocity;          // m/s
  Vec3Array angular_velocity;  // rad/s
  Vec3Array force;             // N, contact forces of the last force step (gravity is not in it)
  Vec3Array torque;            // N m
  Array<double> rolling_cap;   // N m, sum of mu_r |f_n| over the contacts: what rolling friction can resist
  Vec3Array reference;         // m, position when the neighbour list was made
  Array<double> list_margin;   // m, how far the grain may go from there before the list is stale
  Array<double> radius;        // m
  Array<double> mass;          // kg
  Array<std::int32_t> material;
  Array<std::int32_t> id;     // fixed for the whole run, unique
  Array<std::int32_t> layer;  // horizontal layer at the start, for tracing the flow
  Array<std::int32_t>
      turns;  // faces crossed: the unrolled position is the position turned by `turns` sector angles

  SeenTable seen;  // written by each step, for grains and images

  Index count() const { return static_cast<Index>(id.size()); }

  /// Calls visit(FieldInfo, array) for every field of a grain: the list that resize, sort, insertion and
  /// checkpoints walk, and in which frames look up what they write. `Self` is Particles or const Particles.
  template <class Self, class Visit>
  static void for_each_field(Self& p, Visit&& visit) {
    visit(FieldInfo{"x", "m", "position"}, p.position.x);
    visit(FieldInfo{"y", "m", "position"}, p.position.y);
    visit(FieldInfo{"z", "m", "position"}, p.position.z);
    visit(FieldInfo{"vx", "m/s", "velocity"}, p.velocity.x);
    visit(FieldInfo{"vy", "m/s", "velocity"}, p.velocity.y);
    visit(FieldInfo{"vz", "m/s", "velocity"}, p.velocity.z);
    visit(FieldInfo{"wx", "rad/s", "angular velocity"}, p.angular_velocity.x);
    visit(FieldInfo{"wy", "rad/s", "angular velocity"}, p.angular_velocity.y);
    visit(FieldInfo{"wz", "rad/s", "angular velocity"}, p.angular_velocity.z);
    visit(FieldInfo{"fx", "N", "sum of contact forces"}, p.force.x);
    visit(FieldInfo{"fy", "N", "sum of contact forces"}, p.force.y);
    visit(FieldInfo{"fz", "N", "sum of contact forces"}, p.force.z);
    visit(FieldInfo{"tx", "N m", "sum of contact torques"}, p.torque.x);
    visit(FieldInfo{"ty", "N m", "sum of contact torques"}, p.torque.y);
    visit(FieldInfo{"tz", "N m", "sum of contact torques"}, p.torque.z);
    visit(FieldInfo{"rolling_cap", "N m", "torque that rolling friction can resist"}, p.rolling_cap);
    visit(FieldInfo{"reference_x", "m", "position when the neighbour list was made"}, p.reference.x);
    visit(FieldInfo{"reference_y", "m", "position when the neighbour list was made"}, p.reference.y);
    visit(FieldInfo{"reference_z", "m", "position when the neighbour list was made"}, p.reference.z);
    visit(FieldInfo{"list_margin", "m", "way from the reference position after which the list is stale"},
          p.list_margin);
    visit(FieldInfo{"radius", "m", "radius"}, p.radius);
    visit(FieldInfo{"mass", "kg", "mass"}, p.mass);
    visit(FieldInfo{"material", "", "index of the material in the scene"}, p.material);
    visit(FieldInfo{"id", "", "identity, fixed for the run"}, p.id);
    visit(FieldInfo{"layer", "", "horizontal layer at the start"}, p.layer);
    visit(FieldInfo{"turns", "", "sector angles by which to turn the position to unroll the path"}, p.turns);
  }

  /// Calls visit(name, field) for what files of grains show (frames, .vtp), vectors as one: a part of the list
  /// above.
  template <class Self, class Visit>
  static void for_each_frame_field(Self& p, Visit&& visit) {
    visit("position", p.position);
    visit("velocity", p.velocity);
    visit("angular_velocity", p.angular_velocity);
    visit("force", p.force);
    visit("torque", p.torque);
    visit("radius", p.radius);
    visit("mass", p.mass);
    visit("material", p.material);
    visit("id", p.id);
    visit("layer", p.layer);
    visit("turns", p.turns);
  }

  /// Post: every field has n slots; images are gone.
  void resize(Index n) {
    for_each_field(*this, [&](const FieldInfo&, auto& field) { field.resize(static_cast<std::size_t>(n)); });
    seen.resize(static_cast<std::size_t>(n));
  }
};

/// Mass of a homogeneous sphere [kg] from its radius [m] and density [kg/m3].
inline double sphere_mass(double radius, double density) {
  return density * (4.0 / 3.0) * 3.14159265358979323846 * radius * radius * radius;
}
/// Moment of inertia of a homogeneous sphere about a diameter [kg m2].
template <class Real>
inline Real sphere_inertia(const Real& mass, const Real& radius) {
  return constant<Real>(2.0 / 5.0) * mass * radius * radius;
}

}  // namespace wedge
