// json.hpp: the little JSON wedge writes (a flat object, one key a line) and reads back.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace wedge {

/// `text` as a JSON string, quotes included. Bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);
/// The shortest number that reads back as `value`; null when it is not finite.
std::string json_number(double value);

/// A JSON object being written: keys in the order of the calls.
class JsonObject {
public:
  void add(std::string_view key, std::string_view text) { add_raw(key, json_string(text)); }
  void add(std::string_view key, const char* text) { add_raw(key, json_string(text)); }
  void add(std::string_view key, double value) { add_raw(key, json_number(value)); }
  void add(std::string_view key, std::int64_t value) { add_raw(key, std::to_string(value)); }
  void add(std::string_view key, int value) { add_raw(key, std::to_string(value)); }
  void add(std::string_view key, const std::vector<std::string>& texts);
  /// `json` is a JSON value already.
  void add_raw(std::string_view key, std::string_view json);
  /// The object, one key a line, with a line break at the end.
  std::string text() const;

private:
  std::string lines_;
};

/// Reads a flat JSON object of strings, numbers, true, false and null. Strings come without quotes and escapes, the
/// rest as written. Throws FileError naming `path` and the line when the text is anything else.
std::vector<std::pair<std::string, std::string>> parse_flat_json(std::string_view text, const std::string& path);

}  // namespace wedge
