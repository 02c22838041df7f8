// unfold.hpp: the whole vessel's grains from those of one sector.
#pragma once

#include "core/particles.hpp"
#include "core/symmetry.hpp"

namespace wedge {

/// All copies of the grains of a sector: copy k (0 .. order - 1) of grain i stands in slot k * count() + i, has the
/// id i's id * order + k, and is turned by k sector angles with its velocities and forces. A full vessel or a slot
/// stays as it is. Throws FileError when the ids do not fit into 32 bits.
Particles unfolded(const Particles& grains, const Symmetry& symmetry);

}  // namespace wedge
