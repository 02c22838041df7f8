// sound_scene.hpp: a small sound scene, and what is said when it is spoiled.
#pragma once

#include <string>
#include <vector>

#include "io/scene/diagnostics.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/support/catch.hpp"

namespace wedge::test {

/// A sound scene of few lines; tests spoil it by overrides or by replacing a line.
inline const std::string sound = R"([domain]
angle = 90
outlet = { z = "-10 d" }
[[wall]]
name = "shell"
profile = [["20 d", 0], ["20 d", 0.2]]
material = "steel"
[[wall]]
name = "floor"
profile = [[0, 0], ["20 d", 0]]
material = "steel"
[material.grain]
density = 2500
young = 1e7
poisson = 0.3
[material.steel]
density = 7800
young = 2e11
poisson = 0.25
[contact]
[contact.grain-grain]
sliding = 0.6
rolling = "0.02 d"
[contact.steel-grain]
sliding = 0.5
restitution = 0.8
[particles]
diameter = 0.002
material = "grain"
count = 4000
region = { r = [0, "20 d"], z = [0, 0.2] }
[[stage]]
name = "settle"
until = "at rest"
at_most = 1
[[stage]]
name = "open"
remove = ["floor"]
until = { discharged = 20 }
at_most = 1
)";

inline std::string replaced(std::string text, const std::string& line, const std::string& with) {
  const std::size_t at = text.find(line);
  REQUIRE(at != std::string::npos);
  return text.replace(at, line.size(), with);
}

inline Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "s.toml", overrides, "/data/scenes");
}

/// What is said of a wrong scene; "" when it is accepted.
inline std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline int count_errors(const std::string& text) {
  int errors = 0;
  for (std::size_t at = text.find(": error: "); at != std::string::npos; at = text.find(": error: ", at + 1))
    ++errors;
  return errors;
}

}  // namespace wedge::test
