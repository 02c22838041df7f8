// slice_svg.hpp: a picture of a slice through the bed at the end of a stage.
#pragma once

#include <string>

#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// Picture (SVG) of the grains within 2 mean diameters of the plane y = 0, a sector unfolded to the whole vessel,
/// coloured by speed, with the walls and a colour bar; its title names scene, domain, stage and time. Throws
/// FileError.
void write_slice_svg(const std::string& path, const State& state, const Scene& scene, const std::string& stage);

}  // namespace wedge
