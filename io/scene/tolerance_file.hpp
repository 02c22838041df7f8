// tolerance_file.hpp: how far compared runs may be from their reference, as a TOML file says it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/scene/diagnostics.hpp"

namespace wedge {

/// One [[tolerance]]: which rows of a comparison it is about, and its bounds, of which it has at least one.
struct Tolerance {
  static constexpr std::array<const char*, 5> keys{"kind", "moment", "region", "quantity", "measure"};
  std::array<std::string, 5> patterns;  // in the order of `keys`; '*' stands for any letters
  std::optional<double> absolute;       // in the row's unit
  std::optional<double> relative;       // of the row's natural scale
  Place place;
};

struct ToleranceFile {
  std::string path, text;
  std::vector<Tolerance> tolerances;
};

/// Throws FileError when the file cannot be read, SceneError with every diagnostic in one message otherwise.
ToleranceFile read_tolerances(const std::string& path);

/// Whether a text fits a pattern with '*' for any letters, none included.
bool fits(const std::string& pattern, const std::string& text);

}  // namespace wedge
