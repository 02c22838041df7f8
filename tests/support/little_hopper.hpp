// little_hopper.hpp: a scene that runs in a second, and how to run it, for tests of whole runs.
#pragma once

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands/commands.hpp"

namespace wedge::test {

/// A little hopper: a bed of two sizes and materials in a sector falls, settles and runs out.
inline const char* const little_hopper = R"(
[domain]
angle = 60
outlet = { z = -0.01 }
[[wall]]
name = "shell"
profile = [[0.03, 0], [0.03, 0.3]]
material = "wall"
[[wall]]
name = "floor"
profile = [[0.02, 0], [0.03, 0]]
material = "wall"
[[wall]]
name = "plug"
profile = [[0, 0], [0.02, 0]]
material = "wall"
[material.grain]
density = 3800
young = 1e7
poisson = 0.3
[material.wall]
density = 3800
young = 1e7
poisson = 0.3
[contact.grain-grain]
sliding = 0.6
rolling = "0.02 d"
[contact.grain-wall]
sliding = 0.5
rolling = "0.02 d"
[particles]
sizes = [{ diameter = 0.005, fraction = 0.5, material = "grain" }, { diameter = 0.004, fraction = 0.5, material = "grain" }]
count = 1500
region = { r = [0, 0.03], z = [0, 0.26] }
speed = 0.2
[[stage]]
name = "settle"
until = 0.15
[[stage]]
name = "discharge"
remove = ["plug"]
until = 0.4
[time]
step = 2e-5
[output]
frames = 0.05
series = 0.01
)";

inline RunArguments arguments_for(const std::string& folder, int threads, std::vector<std::string> overrides = {}) {
  const std::string scene = folder + ".toml";
  std::ofstream(scene) << little_hopper;
  RunArguments a;
  a.scene = scene;
  a.folder = folder;
  a.threads = threads;
  a.overrides = std::move(overrides);
  return a;
}

}  // namespace wedge::test
