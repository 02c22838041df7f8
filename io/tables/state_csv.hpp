// state_csv.hpp: grains as a table of comma-separated values that reads back to the bit.
#pragma once

#include <string>
#include <vector>

#include "core/particles.hpp"

namespace wedge {

/// Writes a header line and a line per grain (no images): id, position [m], velocity [m/s], angular velocity
/// [rad/s], radius [m], name of the material; numbers in the shortest form that reads back as the same double.
/// Throws FileError. Pre: materials[p.material[i]] is the name of a material.
void write_state_csv(const std::string& path, const Particles& p, const std::vector<std::string>& materials);

/// What a grain has when the file has no column for it.
struct StateCsvDefaults {
  double radius = 0;  // m; 0: the file must have the column
  int material = -1;  // -1: the file must have the column
};

/// Reads such a table: columns in any order; radius, material and id may be missing (id: then 0, 1, 2, ...). Empty
/// lines and lines that begin with # are skipped. All that is wrong is thrown as one FileError, up to ten lines
/// "PATH:LINE:COLUMN: error: what": missing, unknown or repeated columns, numbers that are none or not finite, a
/// radius that is not positive, repeated ids, unknown materials. Post: in the order of the file; mass, force,
/// torque, layer, turns and the like are zero.
Particles read_state_csv(const std::string& path, const StateCsvDefaults& defaults,
                         const std::vector<std::string>& materials);

}  // namespace wedge
