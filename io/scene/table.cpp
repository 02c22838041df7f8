// table.cpp: reading of typed, bounded values from one TOML table.
#include "io/scene/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace wedge {

Place SceneReading::place(std::string path) const {
  for (;;) {
    const auto found = places.find(path);
    if (found != places.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return {};
    path.resize(dot);
  }
}

std::string Quantity::breach(double value) const {
  if (!std::isfinite(value)) return "must be a finite number";
  const bool too_low = low_allowed ? value < low : value <= low;
  const bool too_high = high_allowed ? value > high : value >= high;
  if (too_low) return (low_allowed ? "must be at least " : "must be above ") + plain_number(low);
  if (too_high) return (high_allowed ? "must be at most " : "must be below ") + plain_number(high);
  return "";
}

/// The source path of an override's tree is its number, counted from 1, behind a line feed (no file is called so).
Place place_of(const toml::source_region& region) {
  Place place;
  if (region.path && !region.path->empty() && region.path->front() == '\n')
    std::from_chars(region.path->data() + 1, region.path->data() + region.path->size(), place.origin);
  place.line = std::max(1, static_cast<int>(region.begin.line));
  place.column = std::max(1, static_cast<int>(region.begin.column));
  return place;
}

std::string type_name(const toml::node& node) {
  if (node.is_string()) return "a string";
  if (node.is_integer() || node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

TableReader::TableReader(SceneReading& reading, const toml::table* table, std::string path, std::string title,
                         Place fallback)
    : reading_(reading),
      table_(table),
      path_(std::move(path)),
      title_(std::move(title)),
      place_(table ? place_of(table->source()) : fallback) {
  reading_.places[path_] = place_;
}

const toml::node* TableReader::node(const std::string& key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.push_back(key);
  const toml::node* found = table_ ? table_->get(key) : nullptr;
  if (found) reading_.places[path(key)] = place_of(found->source());
  return found;
}

bool TableReader::has(const std::string& key) { return node(key) != nullptr; }

Place TableReader::place(const std::string& key) const { return reading_.place(path(key)); }

void TableReader::error(const std::string& key, std::string what, std::string remedy) {
  reading_.diagnostics.error(place(key), std::move(what), std::move(remedy));
}

void TableReader::missing(const std::string& key, const std::string& remedy) {
  reading_.diagnostics.error(place_, "'" + key + "' is missing in " + title_, remedy);
}

void TableReader::wrong_type(const toml::node& node, const std::string& name, const std::string& wanted,
                             const std::string& remedy) {
  reading_.diagnostics.error(place_of(node.source()),
                             "'" + name + "' must be " + wanted + ", not " + type_name(node), remedy);
}

std::optional<double> TableReader::number_in(const toml::node& node, const std::string& name,
                                             const Quantity& quantity) {
  if (!node.is_integer() && !node.is_floating_point()) {
    wrong_type(node, name, "a number", quantity.meaning);
    return {};
  }
  const double value = *node.value<double>();
  const std::string breach = quantity.breach(value);
  if (breach.empty()) return value;
  reading_.diagnostics.error(place_of(node.source()), "'" + name + "' " + breach + ", not " + plain_number(value),
                             quantity.meaning);
  return {};
}

std::optional<double> TableReader::length_in(const toml::node& node, const std::string& name,
                                             const Quantity& quantity) {
  if (!node.is_string()) return number_in(node, name, quantity);
  const std::string text = *node.value<std::string>();
  const Place at = place_of(node.source());
  const char* end = text.data() + text.size();
  double diameters = 0;
  const auto parsed = std::from_chars(text.data(), end, diameters);
  const char* rest = parsed.ptr;
  while (rest != end && *rest == ' ') ++rest;
  if (parsed.ec != std::errc() || end - rest != 1 || *rest != 'd') {
    reading_.diagnostics.error(at, "'" + name + "' is not a length: \"" + text + "\"",
                               "write a number of metres, such as 0.1, or of mean diameters, such as \"20 d\"");
    return {};
  }
  if (!(reading_.mean_diameter > 0)) {
    if (std::exchange(reading_.size_told, true)) return {};
    reading_.diagnostics.error(at, "'" + name + "' is given in diameters, but the diameter is not known",
                               "give [particles] a diameter or a file of grains that can be read, or write metres");
    return {};
  }
  const double value = diameters * reading_.mean_diameter;
  const std::string breach = quantity.breach(value);
  if (breach.empty()) return value;
  reading_.diagnostics.error(at, "'" + name + "' " + breach + ", not " + plain_number(value) + " m",
                             quantity.meaning);
  return {};
}

std::optional<double> TableReader::number(const std::string& key, const Quantity& quantity) {
  const toml::node* found = node(key);
  return found ? number_in(*found, key, quantity) : std::nullopt;
}

std::optional<double> TableReader::length(const std::string& key, const Quantity& quantity) {
  const toml::node* found = node(key);
  return found ? length_in(*found, key, quantity) : std::nullopt;
}

std::optional<double> TableReader::number_or_auto(const std::string& key, const Quantity& quantity,
                                                  bool is_length) {
  const toml::node* found = node(key);
  if (!found) return {};
  if (found->is_string() && *found->value<std::string>() == "auto") return 0.0;
  const Quantity with_auto{quantity.meaning + ", or \"auto\"", quantity.low, quantity.high, quantity.low_allowed,
                           quantity.high_allowed};
  return is_length ? length_in(*found, key, with_auto) : number_in(*found, key, with_auto);
}

std::optional<std::int64_t> TableReader::integer(const std::string& key, const std::string& meaning,
                                                 std::int64_t least) {
  const toml::node* found = node(key);
  if (!found) return {};
  const std::optional<double> whole = found->is_floating_point() ? found->value<double>() : std::nullopt;
  if (whole && !(std::floor(*whole) == *whole && std::fabs(*whole) < 9e15)) {
    error(key, "'" + key + "' must be a whole number, not " + plain_number(*whole), meaning);
    return {};
  }
  if (!found->is_integer() && !whole) {
    wrong_type(*found, key, "a whole number", meaning);
    return {};
  }
  const std::int64_t value = whole ? static_cast<std::int64_t>(*whole) : *found->value<std::int64_t>();
  if (value >= least) return value;
  error(key, "'" + key + "' must be at least " + std::to_string(least) + ", not " + std::to_string(value), meaning);
  return {};
}

std::optional<bool> TableReader::boolean(const std::string& key) {
  const toml::node* found = node(key);
  if (!found) return {};
  if (!found->is_boolean()) {
    wrong_type(*found, key, "true or false", "write " + key + " = true or " + key + " = false");
    return {};
  }
  return *found->value<bool>();
}

std::optional<std::string> TableReader::text(const std::string& key, const std::string& meaning) {
  const toml::node* found = node(key);
  if (!found) return {};
  if (!found->is_string()) {
    wrong_type(*found, key, "a string", meaning);
    return {};
  }
  return *found->value<std::string>();
}

std::optional<std::vector<std::string>> TableReader::texts(const std::string& key, const std::string& meaning) {
  const toml::node* found = node(key);
  if (!found) return {};
  if (!found->is_array()) {
    wrong_type(*found, key, "a list of strings", meaning);
    return {};
  }
  std::vector<std::string> words;
  for (const toml::node& entry : *found->as_array()) {
    reading_.places[path(key) + "." + std::to_string(words.size())] = place_of(entry.source());
    if (!entry.is_string()) wrong_type(entry, key, "a list of strings", meaning);
    words.push_back(entry.is_string() ? *entry.value<std::string>() : "");
  }
  return words;
}

std::optional<std::vector<double>> TableReader::numbers(const std::string& key, const Quantity& quantity) {
  const toml::node* found = node(key);
  if (!found) return {};
  if (!found->is_array()) {
    wrong_type(*found, key, "a list of numbers", quantity.meaning);
    return {};
  }
  std::vector<double> values;
  for (const toml::node& entry : *found->as_array())
    if (const auto value = number_in(entry, key, quantity)) values.push_back(*value);
  if (values.size() != found->as_array()->size()) return {};
  return values;
}

std::optional<std::pair<double, double>> TableReader::interval(const std::string& key, const Quantity& quantity) {
  const toml::node* found = node(key);
  if (!found) return {};
  const toml::array* ends = found->as_array();
  if (!ends || ends->size() != 2) {
    error(key, "'" + key + "' must be [lowest, highest]", quantity.meaning);
    return {};
  }
  const auto low = length_in(*ends->get(0), key, quantity), high = length_in(*ends->get(1), key, quantity);
  if (!low || !high) return {};
  if (*low < *high) return std::make_pair(*low, *high);
  error(key, "'" + key + "' must rise: " + plain_number(*low) + " is not below " + plain_number(*high),
        "write [lowest, highest]");
  return {};
}

const toml::table* TableReader::table(const std::string& key) {
  const toml::node* found = node(key);
  if (!found) return nullptr;
  if (!found->is_table()) wrong_type(*found, key, "a table", "write " + key + " = { ... }");
  return found->as_table();
}

void TableReader::refuse_word(const std::string& key, const std::string& word,
                              const std::vector<std::string>& built, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), word) != known.end())
    error(key, key + " '" + word + "' is known but not built yet; use " + one_of(built));
  else
    error(key, "unknown " + key + " '" + word + "'", suggestion(word, built));
}

void TableReader::finish() {
  if (!table_) return;
  for (auto&& [key, value] : *table_) {
    const std::string name(key.str());
    if (std::find(known_.begin(), known_.end(), name) != known_.end()) continue;
    reading_.diagnostics.error(place_of(key.source()), "unknown key '" + name + "' in " + title_,
                               suggestion(name, known_));
  }
}

}  // namespace wedge
