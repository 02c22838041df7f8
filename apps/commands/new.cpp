// new.cpp: wedge new: a commented scene to start from, on standard output.
#include <iostream>

#include "apps/commands/commands.hpp"
#include "apps/commands/embedded_files.hpp"
#include "io/scene/diagnostics.hpp"

namespace wedge {

int command_new(const std::string& name) {
  std::vector<std::string> names;
  for (const EmbeddedFile& scene : embedded_scenes()) {
    if (scene.name == name) {
      std::cout << scene.text;
      return exit_code::ok;
    }
    names.push_back(scene.name);
  }
  std::cerr << "wedge: no scene is called '" << name << "'; " << suggestion(name, names) << '\n';
  return exit_code::usage;
}

}  // namespace wedge
