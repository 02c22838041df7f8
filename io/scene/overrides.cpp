// overrides.cpp: reading of an override as a small TOML document and grafting of its one value onto the tree.
#include "io/scene/overrides.hpp"

#include <charconv>
#include <optional>
#include <utility>

namespace wedge {

namespace {

const char* const how_to_write = "write --set table.key=value, such as --set domain.angle=90";

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string quoted(const std::string& word) {
  std::string text = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

/// Is it a number that no double can hold?
bool too_large(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc::result_out_of_range && end == text.data() + text.size();
}

/// The override as a document whose source path is its number (see place_of). A value that is no TOML value and
/// does not look like one is a bare word.
std::optional<toml::table> read_override(const std::string& text, int origin, Diagnostics& diagnostics) {
  const Place place{origin, 1, 1};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || text.find('\n') != std::string::npos) {
    diagnostics.error(place, "not of the form table.key=value", how_to_write);
    return {};
  }
  const std::string key = trimmed(text.substr(0, equals)), value = trimmed(text.substr(equals + 1));
  const std::string source = "\n" + std::to_string(origin);
  try {
    (void)toml::parse(key + " = 0");
  } catch (const toml::parse_error&) {
    diagnostics.error(place, "'" + key + "' is not a key", how_to_write);
    return {};
  }
  if (too_large(value)) {
    diagnostics.error(place, "no double can hold " + value, "numbers from 5e-324 to 1.7e308 can be told apart");
    return {};
  }
  const bool bare = !value.empty() && std::string("[{\"'").find(value.front()) == std::string::npos;
  std::string why;
  for (const std::string& reading : {value, bare ? quoted(value) : value}) {
    try {
      return toml::parse(key + " = " + reading, source);
    } catch (const toml::parse_error& error) {
      why = error.description();
    }
  }
  diagnostics.error(place, "the value cannot be read: " + why,
                    "write a TOML value: a number, true, \"text\", [a list] or { key = value }");
  return {};
}

toml::table* named_entry(toml::array& entries, const std::string& name) {
  for (toml::node& entry : entries) {
    toml::table* table = entry.as_table();
    if (table && table->get("name") && table->get("name")->value<std::string>() == name) return table;
  }
  return nullptr;
}

std::vector<std::string> entry_names(const toml::array& entries) {
  std::vector<std::string> names;
  for (const toml::node& entry : entries) {
    const toml::table* table = entry.as_table();
    const auto name = table && table->get("name") ? table->get("name")->value<std::string>() : std::nullopt;
    if (name) names.push_back(*name);
  }
  return names;
}

/// Puts the chain of single keys `graft` into `tree`: goes down as far as both have tables, then assigns.
void put(toml::table& tree, toml::table& graft, int origin, Diagnostics& diagnostics, const std::string& parent) {
  for (auto&& [key, value] : graft) {
    const std::string name = parent == "contact" ? pair_key(tree, std::string(key.str())) : std::string(key.str());
    toml::node* there = tree.get(name);
    toml::table* below = value.as_table();
    if (there && below && there->is_table() && !below->is_inline()) {
      put(*there->as_table(), *below, origin, diagnostics, name);
    } else if (there && below && there->is_array() && (name == "wall" || name == "stage")) {
      for (auto&& [entry, inner] : *below) {
        toml::table* target = named_entry(*there->as_array(), std::string(entry.str()));
        if (target && inner.is_table())
          put(*target, *inner.as_table(), origin, diagnostics, "");
        else
          diagnostics.error({origin, 1, 1}, "no " + name + " is named '" + std::string(entry.str()) + "'",
                            suggestion(std::string(entry.str()), entry_names(*there->as_array())));
      }
    } else {
      const toml::key where(name, key.source());
      value.visit([&](auto& node) { tree.insert_or_assign(where, std::move(node)); });
    }
  }
}

}  // namespace

std::string pair_key(const toml::table& contact, const std::string& name) {
  if (contact.contains(name)) return name;
  for (std::size_t dash = name.find('-'); dash != std::string::npos; dash = name.find('-', dash + 1)) {
    const std::string reversed = name.substr(dash + 1) + "-" + name.substr(0, dash);
    if (contact.contains(reversed)) return reversed;
  }
  return name;
}

void apply_overrides(toml::table& tree, const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < overrides.size(); ++i) {
    const int origin = static_cast<int>(i) + 1;
    std::optional<toml::table> graft = read_override(overrides[i], origin, diagnostics);
    if (graft) put(tree, *graft, origin, diagnostics, "");
  }
}

}  // namespace wedge
