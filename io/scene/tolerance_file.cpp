// tolerance_file.cpp: reading of tolerance files, with the same care for mistakes as scene files.
#include "io/scene/tolerance_file.hpp"

#include <algorithm>

#include "io/files/atomic_file.hpp"
#include "io/scene/sections.hpp"
#include "io/scene/table.hpp"

namespace wedge {
namespace {

Tolerance read_one(SceneReading& reading, const toml::table& table, std::size_t number) {
  TableReader reader(reading, &table, "tolerance." + std::to_string(number), "[[tolerance]]");
  Tolerance tolerance;
  tolerance.place = reader.here();
  for (std::size_t k = 0; k < Tolerance::keys.size(); ++k)
    tolerance.patterns[k] = reader.text(Tolerance::keys[k], "write a name, or \"*\" for all").value_or("*");
  const bool bounded = reader.has("absolute") || reader.has("relative");
  tolerance.absolute =
      reader.number("absolute", Quantity::not_negative("the largest difference or distance, in the row's unit"));
  tolerance.relative = reader.number(
      "relative", Quantity::not_negative("the largest share of the reference's scale, such as 0.05 for 5 %"));
  if (!bounded) reader.missing("relative", "write relative = 0.05, or absolute = ... in the quantity's unit");
  reader.finish();
  return tolerance;
}

}  // namespace

ToleranceFile read_tolerances(const std::string& path) {
  ToleranceFile file{path, read_text_file(path), {}};
  SceneReading reading{Diagnostics(path, file.text, {}), {}, 0, false, ""};
  toml::table root;
  try {
    root = toml::parse(file.text, path);
  } catch (const toml::parse_error& error) {
    reading.diagnostics.error(place_of(error.source()), std::string(error.description()),
                              "the file is not TOML from here on; see https://toml.io");
    reading.diagnostics.throw_if_wrong();
  }
  for (auto&& [key, node] : root) {
    const std::string name(key.str());
    if (name != "tolerance")
      reading.diagnostics.error(place_of(key.source()), "unknown table '" + name + "'",
                                "write [[tolerance]] for each bound");
  }
  if (const toml::array* list = open_tables(reading, root, "tolerance"))
    for (const toml::node& node : *list)
      file.tolerances.push_back(read_one(reading, *node.as_table(), file.tolerances.size()));
  if (file.tolerances.empty() && reading.diagnostics.clean())
    reading.diagnostics.error({}, "there is no tolerance in this file", "write [[tolerance]] for each bound");
  reading.diagnostics.throw_if_wrong();
  return file;
}

bool fits(const std::string& pattern, const std::string& text) {
  // reach[k]: whether the pattern so far fits the first k letters.
  std::vector<bool> reach(text.size() + 1, false);
  reach[0] = true;
  for (const char c : pattern) {
    std::vector<bool> next(text.size() + 1, false);
    for (std::size_t k = 0; k <= text.size(); ++k) {
      if (c == '*')
        next[k] = reach[k] || (k > 0 && next[k - 1]);
      else
        next[k] = k > 0 && reach[k - 1] && text[k - 1] == c;
    }
    reach = next;
  }
  return reach[text.size()];
}

}  // namespace wedge
