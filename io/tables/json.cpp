// json.cpp: nlohmann::json with our layout and our errors.
#include "io/tables/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

/// "2:7", line and column of the byte `number` (from 1) of `text`.
std::string place_of(std::size_t number, std::string_view text) {
  const std::string_view before = text.substr(0, number > 0 ? number - 1 : 0);
  const std::size_t line_break = before.rfind('\n');
  const std::size_t column = before.size() - (line_break == std::string_view::npos ? 0 : line_break + 1);
  return std::to_string(std::count(before.begin(), before.end(), '\n') + 1) + ":" + std::to_string(column + 1);
}

/// What the library says without its own name and place: "[json...] parse error at line 1, column 2: WHAT".
std::string reason(const std::string& message) {
  const std::string_view end_of_place = message.find("parse error at") == std::string::npos ? "] " : ": ";
  const std::size_t place = message.find(end_of_place);
  return place == std::string::npos ? message : message.substr(place + end_of_place.size());
}

}  // namespace

std::string json_text(const Json& value) {
  return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json parse_json(std::string_view text, const std::string& path) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw_file_error(path + ":" + place_of(error.byte, text), "is not JSON: " + reason(error.what()));
  } catch (const Json::exception& error) {  // a number beyond the range of a double
    throw_file_error(path, "is not JSON that wedge can read: " + reason(error.what()));
  }
}

}  // namespace wedge
