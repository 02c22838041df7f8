// overrides.hpp: "--set table.key=value" put into the tree of a scene file before it is checked. Internal to
// io.
#pragma once

#include <string>
#include <vector>

#include <toml++/toml.h>

#include "io/scene/diagnostics.hpp"

namespace wedge {

/// Puts each override into the tree, in order. Complains about those that cannot be read or name no wall or stage.
void apply_overrides(toml::table& tree, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

/// The key of the table that stands for the pair in `name` ("A-B"), which may be written "B-A"; `name` when neither
/// is.
std::string pair_key(const toml::table& contact, const std::string& name);

}  // namespace wedge
