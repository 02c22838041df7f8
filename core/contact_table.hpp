// contact_table.hpp: the near pairs of grains (one row each) and of grains with walls, with their histories.
#pragma once

#include <cstdint>

#include "core/particles.hpp"

namespace wedge {

/// Half list of near pairs. Row k is the pair of grain first[k] and slot second[k] (a grain or an image). The grain
/// with the smaller id is `first`, so a pair is stored once, seam pairs included, and a history never changes
/// sides. A row's identity is (id of first, id of the partner, turn), see row_partner in state.hpp; `history` is in
/// the frame of `first`. Rows of one grain are consecutive: those of grain i are row_begin[i] .. row_begin[i+1]-1.
struct ContactTable {
  Array<Index> row_begin;  // count()+1 entries
  Array<Index> first, second;
  Vec3Array history;  // m, tangential displacement (see kernels/README.md for its half-step part)

  // Kept only where rows have rolling couples (rolling_velocity `relative`, elastic_plastic_spring).
  Vec3Array couple;            // N m, on `first`; the other grain feels its negative. Written by each force step
  Vec3Array rolling_moment;    // N m, of the rolling spring, in the frame of `first`; its half step like `history`
  Array<Index> contact_count;  // contacts of each slot's grain; scratch of each force step

  Index rows() const { return static_cast<Index>(first.size()); }

  /// Visits what has rows() entries.
  template <class Self, class Visit>
  static void for_each_field(Self& c, Visit&& visit) {
    visit(FieldInfo{"first", "", "slot of the grain with the smaller id"}, c.first);
    visit(FieldInfo{"second", "", "slot of the other grain or of its image"}, c.second);
    visit(FieldInfo{"history_x", "m", "tangential displacement"}, c.history.x);
    visit(FieldInfo{"history_y", "m", "tangential displacement"}, c.history.y);
    visit(FieldInfo{"history_z", "m", "tangential displacement"}, c.history.z);
  }

  /// Visits what has rows() entries where rows have couples, and none elsewhere.
  template <class Self, class Visit>
  static void for_each_couple_field(Self& c, Visit&& visit) {
    visit(FieldInfo{"couple_x", "N m", "rolling couple on the first grain"}, c.couple.x);
    visit(FieldInfo{"couple_y", "N m", "rolling couple on the first grain"}, c.couple.y);
    visit(FieldInfo{"couple_z", "N m", "rolling couple on the first grain"}, c.couple.z);
    visit(FieldInfo{"rolling_moment_x", "N m", "moment of the rolling spring"}, c.rolling_moment.x);
    visit(FieldInfo{"rolling_moment_y", "N m", "moment of the rolling spring"}, c.rolling_moment.y);
    visit(FieldInfo{"rolling_moment_z", "N m", "moment of the rolling spring"}, c.rolling_moment.z);
  }

  void resize(Index rows) {
    for_each_field(*this, [&](const FieldInfo&, auto& field) { field.resize(static_cast<std::size_t>(rows)); });
  }
};

/// Near pairs of grains and wall features (see vessel.hpp). Rows of one grain are consecutive; grains ascend.
/// Grain grain[g] has the rows begin[g] .. begin[g+1]-1.
struct WallContactTable {
  Array<Index> grain, begin;     // `begin` has one entry more than `grain`
  Array<std::int32_t> feature;   // which segment, edge or plane
  Array<std::int32_t> touching;  // 1 while in contact
  Vec3Array history;             // m
  Vec3Array normal;              // unit vector grain -> wall, of the last force step
  Vec3Array force;               // N, on the grain
  Vec3Array torque;              // N m, on the grain
  Array<double> overlap;         // m
  Vec3Array rolling_moment;      // N m, of the rolling spring

  Index rows() const { return static_cast<Index>(feature.size()); }

  template <class Self, class Visit>
  static void for_each_field(Self& c, Visit&& visit) {
    visit(FieldInfo{"feature", "", "wall feature"}, c.feature);
    visit(FieldInfo{"touching", "", "1 while in contact"}, c.touching);
    visit(FieldInfo{"history_x", "m", "tangential displacement"}, c.history.x);
    visit(FieldInfo{"history_y", "m", "tangential displacement"}, c.history.y);
    visit(FieldInfo{"history_z", "m", "tangential displacement"}, c.history.z);
    visit(FieldInfo{"normal_x", "", "unit normal of the last force step"}, c.normal.x);
    visit(FieldInfo{"normal_y", "", "unit normal of the last force step"}, c.normal.y);
    visit(FieldInfo{"normal_z", "", "unit normal of the last force step"}, c.normal.z);
    visit(FieldInfo{"force_x", "N", "force on the grain"}, c.force.x);
    visit(FieldInfo{"force_y", "N", "force on the grain"}, c.force.y);
    visit(FieldInfo{"force_z", "N", "force on the grain"}, c.force.z);
    visit(FieldInfo{"torque_x", "N m", "torque on the grain"}, c.torque.x);
    visit(FieldInfo{"torque_y", "N m", "torque on the grain"}, c.torque.y);
    visit(FieldInfo{"torque_z", "N m", "torque on the grain"}, c.torque.z);
    visit(FieldInfo{"overlap", "m", "overlap"}, c.overlap);
    visit(FieldInfo{"rolling_moment_x", "N m", "moment of the rolling spring"}, c.rolling_moment.x);
    visit(FieldInfo{"rolling_moment_y", "N m", "moment of the rolling spring"}, c.rolling_moment.y);
    visit(FieldInfo{"rolling_moment_z", "N m", "moment of the rolling spring"}, c.rolling_moment.z);
  }
  void resize(Index rows) {
    for_each_field(*this, [&](const FieldInfo&, auto& field) { field.resize(static_cast<std::size_t>(rows)); });
  }
};

}  // namespace wedge
