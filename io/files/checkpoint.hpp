// checkpoint.hpp: everything a run needs to go on bit for bit, in one file that knows whether it is intact.
//
// A checkpoint is an HDF5 file behind a head of 512 bytes (the user block, which HDF5 tools skip). The head says in
// one line of text how long the file is and the XXH3 checksum (64 bits) of every byte after the head: a file that
// was cut short or changed anywhere is refused before HDF5 looks at it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/state.hpp"

namespace wedge {

/// What the driver of a run keeps with the state.
struct CheckpointExtra {
  std::string scene_text;
  std::string resolved_scene;
  std::vector<std::pair<std::string, std::string>> run_state;  // in order; no '\0' in keys and values
};

/// Of the format. A change of what a checkpoint holds, a new field of grains too, is a new version.
inline constexpr int checkpoint_version = 5;

/// "FOLDER/checkpoint_000000001234.hdf" for step 1234.
std::string checkpoint_path(const std::string& folder, std::int64_t step);

/// Writes the state in doubles, with what contacts saw in the last force step, from which their forces can be had.
/// Throws FileError. Pre: every field has count() entries, those of images have count() + images; between two
/// steps.
void write_checkpoint(const std::string& path, const State& state, const CheckpointExtra& extra);

/// Fills `state` from a checkpoint. Throws FileError when the file is missing, cut short or changed, or belongs to
/// another symmetry or other walls; `state` may then be half filled.
/// Pre: state.symmetry and state.vessel are made from the scene.
/// Post: all else is as written, what contacts saw in the last force step included.
CheckpointExtra read_checkpoint(const std::string& path, State& state);

/// The texts of a checkpoint alone: from its scene the caller makes symmetry and vessel. Throws as read_checkpoint.
CheckpointExtra read_checkpoint_extra(const std::string& path);

/// Whether the file is there and whole, by its checksum.
bool checkpoint_is_valid(const std::string& path);

/// The checkpoint with the most steps that is whole; nothing when there is none. Throws FileError when the folder
/// cannot be read.
std::optional<std::string> newest_valid_checkpoint(const std::string& folder);

/// Renames the checkpoints with more steps than `newest`, which are damaged, to NAME.damaged: counted among the
/// last ones they would drive out whole ones. Returns what they were called.
std::vector<std::string> set_aside_later(const std::string& folder, const std::string& newest);

/// A whole checkpoint of this step in the folder, whatever its name; nothing when there is none. Throws FileError
/// when the folder cannot be read.
std::optional<std::string> checkpoint_of_step(const std::string& folder, std::int64_t step);

/// Gives a checkpoint a second name that keep_last leaves alone: a link where the disk has links, else a copy.
/// Post: `second` holds the checkpoint, or FileError was thrown and `second` is as before.
void keep_as(const std::string& path, const std::string& second);

/// Removes all checkpoints of a folder but the `count` with the most steps, and what broken writes left behind.
/// Throws FileError.
void keep_last(const std::string& folder, std::size_t count);

}  // namespace wedge
