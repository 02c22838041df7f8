// json.hpp: JSON text written the way wedge writes it, and read with errors that name file and line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace wedge {

/// A JSON value whose objects keep the order in which their keys were added. Files that make or read one include
/// <nlohmann/json.hpp>, which takes long to compile; headers do not.
using Json = nlohmann::ordered_json;

/// `value` with one key a line and a line break at the end. Numbers are the shortest that read back as the same,
/// null where they are not finite; bytes that are not UTF-8 become U+FFFD.
std::string json_text(const Json& value);

/// Reads JSON. Throws FileError that names `path` and the line, and says what was expected, when `text` is none.
Json parse_json(std::string_view text, const std::string& path);

}  // namespace wedge
