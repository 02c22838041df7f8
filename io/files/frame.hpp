// frame.hpp: frames, the pictures of a run at one time: grains and contacts, for ParaView and for analysis.
//
// A frame is one HDF5 file. Group `particles` (or `contacts`) holds one dataset per field, vectors as n x 3, each
// with the attributes name, unit and meaning; the attributes of the file hold format, format_version, time, step
// and number; dataset `scene` holds the scene text. Group VTKHDF (version 1.0, an UnstructuredGrid of VTK vertices
// or lines) holds hard links to the same data. A file without grains or contacts is valid.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/state.hpp"

namespace wedge {

/// What a frame says about itself besides its state.
struct FrameInfo {
  std::string scene_text;
  FramePrecision precision = FramePrecision::single_precision;
  std::int64_t number = 0;
};

/// Writes the grains of `state` (no images). Throws FileError.
/// Pre: the particle arrays have at least count() entries.
void write_particle_frame(const std::string& path, const State& state, const FrameInfo& info);

/// Writes the rows of state.contacts that touch (row_overlap > 0); contacts with walls are left out. A contact
/// across a face is drawn to the image. Throws FileError. Pre: image positions and normals are those of the last
/// force step; `forces` has the force on the first grain of each row [N].
void write_contact_frame(const std::string& path, const State& state, const Vec3Array& forces,
                         const FrameInfo& info);

/// What a frame says about itself.
struct FrameHeader {
  double time = 0;  // s
  std::int64_t step = 0;
  FrameInfo info;
};

struct ParticleFrame {
  FrameHeader header;
  Particles particles;  // rolling_cap, reference and the velocities seen are not in a frame: zero
};

/// Contacts of a frame, one entry each. Forces act on the first grain, which has the smaller id.
struct ContactFrame {
  FrameHeader header;
  Array<std::int32_t> first_id, second_id, turn;
  Vec3Array first_position, second_position;  // m, centres; the second one of the image across a face
  Vec3Array normal;                           // unit vector first -> second
  Vec3Array normal_force, tangential_force;   // N
  Array<double> normal_load;                  // N, > 0 when the grains push, < 0 when they pull
  Array<double> tangential_load;              // N, length of the tangential force
  Array<double> overlap;                      // m

  std::size_t size() const { return first_id.size(); }

  /// Visits every field but the two positions, also of a type that has members of these names.
  template <class Self, class Visit>
  static void for_each_field(Self& c, Visit&& visit) {
    visit(FieldInfo{"first_id", "", "id of the grain on which the forces act"}, c.first_id);
    visit(FieldInfo{"second_id", "", "id of the other grain"}, c.second_id);
    visit(FieldInfo{"turn", "", "turn at which the other grain is seen; 0: in the domain"}, c.turn);
    visit(FieldInfo{"normal", "", "unit vector from the first grain to the second"}, c.normal);
    visit(FieldInfo{"normal_force", "N", "normal part of the force on the first grain"}, c.normal_force);
    visit(FieldInfo{"tangential_force", "N", "tangential part of the force on the first grain"},
          c.tangential_force);
    visit(FieldInfo{"normal_load", "N", "normal force, positive when the grains push"}, c.normal_load);
    visit(FieldInfo{"tangential_load", "N", "magnitude of the tangential force"}, c.tangential_load);
    visit(FieldInfo{"overlap", "m", "overlap of the two spheres"}, c.overlap);
  }
};

/// Throw FileError when the file is missing, is no such frame or has other fields.
FrameHeader read_particle_header(const std::string& path);
ParticleFrame read_particle_frame(const std::string& path);
ContactFrame read_contact_frame(const std::string& path);

}  // namespace wedge
