// checks.hpp: whether a scene that was read makes physical sense. Internal to io.
#pragma once

#include "io/scene/table.hpp"

namespace wedge {

/// Complains about what cannot be: too many grains, too long a step, too thin a sector, missing pairs. Values that
/// were already refused (0 where a positive one belongs) are passed over.
void check_scene(SceneReading& reading, const Scene& scene);

/// Volume [m3] of the fill region of the whole vessel, or of the slot.
double fill_volume(const Domain& domain, const RandomFill& fill);

/// Largest distance of a wall from the axis [m], without walls that of the fill region.
double widest_radius(const Scene& scene);

}  // namespace wedge
