// vtp.hpp: grains and walls as VTK PolyData XML files (.vtp), which every VTK program reads.
#pragma once

#include <string>

#include "core/particles.hpp"
#include "core/scene.hpp"
#include "core/vessel.hpp"

namespace wedge {

/// Writes the grains (no images) as points with radius [m], velocity [m/s], angular velocity [rad/s], force [N],
/// mass [kg], material, id, layer and turns, in double precision. Throws FileError.
void write_particles_vtp(const std::string& path, const Particles& p);

/// Writes the walls that are present, where they stand now: profiles turned about z in 96 pieces per full turn (a
/// sector over its angle alone), in a slot drawn out along y over its width; cells carry the index of their wall.
/// Throws FileError.
void write_vessel_vtp(const std::string& path, const Vessel& vessel, const Domain& domain);

}  // namespace wedge
