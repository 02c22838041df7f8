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

/// A step that lasts more than these parts of the Rayleigh time is refused, or doubtful: from 25 % on a bed may
/// never come to rest (tests/README.md, "Hard cases").
constexpr double refused_step = 40.0 / 100.0, doubtful_step = 20.0 / 100.0;
/// Law `linear`: the same, in parts of the contact time.
constexpr double refused_linear_step = 1.0 / 5.0, doubtful_linear_step = 1.0 / 20.0;

}  // namespace wedge
