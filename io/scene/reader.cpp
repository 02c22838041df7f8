// reader.cpp: from the text of a scene file to a checked Scene.
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "io/scene/checks.hpp"
#include "io/scene/overrides.hpp"
#include "io/scene/scene_file.hpp"
#include "io/scene/sections.hpp"

namespace wedge {

namespace {

const std::vector<std::string> section_names{"domain", "wall", "material", "contact", "particles", "stage",
                                             "rest",   "time", "output",   "start",   "run"};

void refuse_unknown_sections(SceneReading& reading, const toml::table& root) {
  for (auto&& [key, node] : root) {
    const std::string name(key.str());
    if (std::find(section_names.begin(), section_names.end(), name) != section_names.end()) continue;
    const std::string what =
        node.is_table() || node.is_array() ? "unknown table '" : "key outside of every table: '";
    reading.diagnostics.error(place_of(key.source()), what + name + "'", suggestion(name, section_names));
  }
}

Scene read_tree(SceneReading& reading, const toml::table& root) {
  Scene scene;
  refuse_unknown_sections(reading, root);
  read_materials(reading, root, scene);
  TableReader particles = open_table(reading, root, "particles");
  const std::size_t told = reading.diagnostics.count();
  read_grain_sizes(particles, scene);
  reading.size_told = reading.diagnostics.count() > told;
  read_domain(reading, root, scene);
  read_grain_source(particles, scene);
  particles.finish();
  read_walls(reading, root, scene);
  read_contact(reading, root, scene);
  read_stages(reading, root, scene);
  read_settings(reading, root, scene);
  return scene;
}

}  // namespace

TableReader open_table(SceneReading& reading, const toml::table& root, const std::string& name) {
  const toml::node* node = root.get(name);
  if (node && !node->is_table())
    reading.diagnostics.error(place_of(node->source()), "'" + name + "' must be a table, not " + type_name(*node),
                              "write [" + name + "]");
  return TableReader(reading, node ? node->as_table() : nullptr, name, "[" + name + "]");
}

const toml::array* open_tables(SceneReading& reading, const toml::table& root, const std::string& name) {
  const toml::node* node = root.get(name);
  if (!node) return nullptr;
  const toml::array* list = node->as_array();
  if (list && (list->empty() || list->is_homogeneous(toml::node_type::table))) return list;
  reading.diagnostics.error(place_of(node->source()), "'" + name + "' must be a list of tables",
                            "write [[" + name + "]] with two brackets for each " + name);
  return nullptr;
}

Scene parse_scene(const std::string& text, const std::string& file_name, const std::vector<std::string>& overrides,
                  std::string base_folder) {
  SceneReading reading{Diagnostics(file_name, text, overrides), {}, 0, false, std::move(base_folder)};
  toml::table root;
  try {
    root = toml::parse(text, file_name);
  } catch (const toml::parse_error& error) {
    reading.diagnostics.error(place_of(error.source()), std::string(error.description()),
                              "the file is not TOML from here on; see https://toml.io");
    reading.diagnostics.throw_if_wrong();
  }
  apply_overrides(root, overrides, reading.diagnostics);
  Scene scene = read_tree(reading, root);
  check_scene(reading, scene);
  reading.diagnostics.throw_if_wrong();
  scene.name = std::filesystem::path(file_name).stem().string();
  scene.text = text;
  scene.overrides = overrides;
  return scene;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  if (std::filesystem::is_directory(path)) throw FileError("the scene file '" + path + "' is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad())
    throw FileError("cannot read the scene file '" + path + "': " + std::strerror(errno));
  return parse_scene(text, path, overrides, std::filesystem::path(path).parent_path().string());
}

void require_sources(const Scene& scene) {
  const auto there = [](const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored);
  };
  const auto* file = std::get_if<StateFile>(&scene.particles.grains);
  if (!scene.start_from.empty() && !there(scene.start_from))
    throw FileError("start.from: '" + scene.start_from +
                    "' does not exist; name the folder of a run, or a file of its folder checkpoints");
  if (scene.start_from.empty() && file && !there(file->path))
    throw FileError("particles.file: '" + file->path +
                    "' does not exist; name a table of grains, such as `wedge export --to csv` writes");
}

}  // namespace wedge
