// scene_file.hpp: scene files: TOML text to a checked Scene and back. All validation and all its messages live
// here.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

/// Reads, checks and returns the scene in the file `path`.
/// `overrides` are "table.key=value" (array tables by name: "wall.NAME.key", "stage.NAME.key"); the value is a TOML
/// value, a bare word is a string. Relative paths in the file belong to its folder, those in an override to the
/// current folder. Throws FileError when the file cannot be read, SceneError with every diagnostic in one message,
/// in order of place, otherwise.
Scene read_scene(const std::string& path, const std::vector<std::string>& overrides);

/// As read_scene, for a text already in memory; `file_name` is what messages call it, `base_folder` where its
/// relative paths belong (empty: the current folder).
Scene parse_scene(const std::string& text, const std::string& file_name, const std::vector<std::string>& overrides,
                  std::string base_folder);

/// The scene as TOML text, every default written out, lengths in metres, paths absolute, free of locale. Reads back
/// to an equal Scene (but for `name`, `text` and `overrides`).
std::string resolved_scene(const Scene& scene);

/// Throws FileError when the run, the checkpoint or the file of grains that the scene is to start from is not
/// there. Reading a scene does not ask for it: a run goes on without.
void require_sources(const Scene& scene);

/// What is doubtful in a checked scene but not wrong, a sentence each.
std::vector<std::string> scene_warnings(const Scene& scene);

}  // namespace wedge
