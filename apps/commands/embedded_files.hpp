// embedded_files.hpp: files of apps as the program carries them: scenes, and the scripts of the report.
#pragma once

#include <string>
#include <vector>

namespace wedge {

struct EmbeddedFile {
  std::string name, text;
};

const std::vector<EmbeddedFile>& embedded_scenes();
const std::vector<EmbeddedFile>& embedded_report();

}  // namespace wedge
