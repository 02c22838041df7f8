// table.hpp: one table of a scene file, read key by key; every complaint knows its place. Internal to io.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "io/scene/diagnostics.hpp"
#include "io/scene/names.hpp"

namespace wedge {

/// What reading a scene shares: the complaints, where each value stood (by path, such as "particles.count"), and
/// the mean diameter [m] that lengths such as "0.02 d" refer to (0: not known).
struct SceneReading {
  Diagnostics diagnostics;
  std::map<std::string, Place> places;
  double mean_diameter = 0;
  bool size_told = false;   // that the diameter is not known was said: lengths in diameters need not say it again
  std::string base_folder;  // where relative paths of the file belong

  /// Place of a value, or of the nearest table around it that was written down.
  Place place(std::string path) const;
};

/// A number's bounds, and what it is, in the words of a remedy ("a density in kg/m3, such as 2500").
struct Quantity {
  std::string meaning;
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true, high_allowed = true;

  static Quantity any(std::string meaning) { return {std::move(meaning)}; }
  static Quantity positive(std::string meaning) { return {std::move(meaning), 0, infinite(), false}; }
  static Quantity not_negative(std::string meaning) { return {std::move(meaning), 0}; }
  static double infinite() { return std::numeric_limits<double>::infinity(); }
  /// "" when the value is within bounds, else which bound it breaks.
  std::string breach(double value) const;
};

Place place_of(const toml::source_region& region);
std::string type_name(const toml::node& node);
class TableReader {
public:
  /// `path` names values in SceneReading::places, `title` the table in messages. A missing table (nullptr) reads as
  /// an empty one that stands at `fallback`.
  TableReader(SceneReading& reading, const toml::table* table, std::string path, std::string title,
              Place fallback = {});

  bool has(const std::string& key);
  const toml::node* node(const std::string& key);  // marks the key as known; nullptr: absent
  Place here() const { return place_; }
  Place place(const std::string& key) const;
  const std::string& title() const { return title_; }
  std::string path(const std::string& key) const { return path_ + "." + key; }
  SceneReading& reading() const { return reading_; }

  void error(const std::string& key, std::string what, std::string remedy = "");
  /// Complains that `key` is missing; `remedy` says what to write.
  void missing(const std::string& key, const std::string& remedy);

  // Each returns nothing when the key is absent or, after a complaint, wrong.
  std::optional<double> number(const std::string& key, const Quantity& quantity);
  std::optional<double> length(const std::string& key, const Quantity& quantity);
  std::optional<double> number_or_auto(const std::string& key, const Quantity& quantity, bool is_length = false);
  std::optional<std::int64_t> integer(const std::string& key, const std::string& meaning, std::int64_t least);
  std::optional<bool> boolean(const std::string& key);
  std::optional<std::string> text(const std::string& key, const std::string& meaning);
  std::optional<std::vector<std::string>> texts(const std::string& key, const std::string& meaning);
  std::optional<std::vector<double>> numbers(const std::string& key, const Quantity& quantity);
  /// [low, high], both lengths, low < high.
  std::optional<std::pair<double, double>> interval(const std::string& key, const Quantity& quantity);
  template <class E>
  std::optional<E> choice(const std::string& key, const Names<E>& names);
  /// A table inside this one; absent or, after a complaint, not a table: nullptr.
  const toml::table* table(const std::string& key);

  /// The same for one value that is not a key's own: an entry of an array.
  std::optional<double> number_in(const toml::node& node, const std::string& name, const Quantity& quantity);
  std::optional<double> length_in(const toml::node& node, const std::string& name, const Quantity& quantity);

  /// Complains about every key that nobody asked for. Call it last.
  void finish();

private:
  void refuse_word(const std::string& key, const std::string& word, const std::vector<std::string>& built,
                   const std::vector<std::string>& known);
  void wrong_type(const toml::node& node, const std::string& name, const std::string& wanted,
                  const std::string& remedy);

  SceneReading& reading_;
  const toml::table* table_;
  std::string path_, title_;
  Place place_;
  std::vector<std::string> known_;
};

template <class E>
std::optional<E> TableReader::choice(const std::string& key, const Names<E>& names) {
  const std::optional<std::string> word = text(key, "use " + one_of(names.words()));
  if (!word) return {};
  for (const auto& [name, value] : names.built)
    if (name == *word) return value;
  refuse_word(key, *word, names.words(), names.known);
  return {};
}

}  // namespace wedge
