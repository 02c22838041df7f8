// gaps.hpp: where the walls of a scene leave a gap that was probably not meant. Internal to io.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

/// Two warnings, a sentence each (apps/scenes/README.md, "Gaps between walls", says when and why):
/// - walls that nearly join: the end of one, which touches no other, is less than the smallest grain away from
///   another, or leaves such a hole at the axis;
/// - a vessel that does not hold its grains: they can get out below the fill region although nothing takes them, or
///   before the stage that is to open the vessel. Looked at for random fills under gravity along -z.
/// Walls count while they are present together; walls that move against one another are not asked to join.
std::vector<std::string> wall_gaps(const Scene& scene);

}  // namespace wedge
