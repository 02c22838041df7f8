// embedded_scenes.hpp: the scenes of apps/scenes as the program carries them.
#pragma once

#include <string>
#include <vector>

namespace wedge {

struct EmbeddedScene {
  std::string name, text;
};

const std::vector<EmbeddedScene>& embedded_scenes();

}  // namespace wedge
