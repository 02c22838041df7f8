// sections.hpp: the tables of a scene file, one reader each, in the order they depend on one another.
// Internal to io.
#pragma once

#include <optional>
#include <string>

#include "io/scene/table.hpp"

namespace wedge {

/// A table of the file's root; complains when it stands there as something else. Absent tables read as empty.
TableReader open_table(SceneReading& reading, const toml::table& root, const std::string& name);
/// An array of tables of the root, such as [[wall]]; nullptr when absent or, after a complaint, something else.
const toml::array* open_tables(SceneReading& reading, const toml::table& root, const std::string& name);

/// Index of the material that `key` of the table names; complains when it is unknown. Absent key: `otherwise`, and
/// a complaint when that is none either.
std::optional<int> read_grain_material(TableReader& table, const Scene& scene, const std::string& key,
                                       std::optional<int> otherwise);
/// The same for a wall, which may be of "rigid".
std::optional<int> read_wall_material(TableReader& table, const Scene& scene, const std::string& key,
                                      std::optional<int> otherwise);

void read_materials(SceneReading& reading, const toml::table& root, Scene& scene);
/// Sizes and materials of the grains; sets reading.mean_diameter. Needs materials.
void read_grain_sizes(TableReader& particles, Scene& scene);
void read_domain(SceneReading& reading, const toml::table& root, Scene& scene);
/// The rest of [particles]. Needs sizes and domain.
void read_grain_source(TableReader& particles, Scene& scene);
void read_walls(SceneReading& reading, const toml::table& root, Scene& scene);
/// [contact] and its pairs. Needs materials.
void read_contact(SceneReading& reading, const toml::table& root, Scene& scene);
void read_stages(SceneReading& reading, const toml::table& root, Scene& scene);
/// [rest], [time], [output], [start], [run].
void read_settings(SceneReading& reading, const toml::table& root, Scene& scene);

/// A path of the file, made absolute: relative to its folder, in an override to the current folder.
std::string absolute_path(const SceneReading& reading, const std::string& path, Place place);

}  // namespace wedge
