// checkpoint_folder.cpp: the checkpoints of a run: which is the newest, which go, which stay.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <string_view>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/files/hdf5_file.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view file_prefix = "checkpoint_", file_suffix = ".hdf", part_suffix = ".hdf.part";

/// Step in the name of a checkpoint file; nothing for other names.
std::optional<std::int64_t> step_in_name(const std::string& name) {
  if (name.size() <= file_prefix.size() + file_suffix.size() ||
      name.compare(0, file_prefix.size(), file_prefix) != 0 ||
      name.compare(name.size() - file_suffix.size(), file_suffix.size(), file_suffix) != 0) {
    return std::nullopt;
  }
  std::int64_t step = 0;
  const char* first = name.data() + file_prefix.size();
  const char* last = name.data() + name.size() - file_suffix.size();
  const auto [end, error] = std::from_chars(first, last, step);
  if (error != std::errc{} || end != last || *first == '-') return std::nullopt;
  return step;
}

/// Names in a folder. Throws FileError.
std::vector<std::string> names_in(const std::string& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    names.push_back(at->path().filename().string());
  }
  if (error) throw FileError(folder + ": cannot read the folder: " + error.message());
  return names;
}

/// Names of the checkpoints in a folder, most steps first.
std::vector<std::string> checkpoints_in(const std::string& folder) {
  std::vector<std::pair<std::int64_t, std::string>> found;
  for (const std::string& name : names_in(folder)) {
    if (const auto step = step_in_name(name)) found.emplace_back(*step, name);
  }
  std::sort(found.rbegin(), found.rend());
  std::vector<std::string> names;
  for (auto& entry : found) names.push_back(std::move(entry.second));
  return names;
}

}  // namespace

std::string checkpoint_path(const std::string& folder, std::int64_t step) {
  char name[64];
  std::snprintf(name, sizeof name, "checkpoint_%012lld.hdf", static_cast<long long>(step));
  return folder + "/" + name;
}

std::optional<std::string> newest_valid_checkpoint(const std::string& folder) {
  for (const std::string& name : checkpoints_in(folder)) {
    const std::string path = folder + "/" + name;
    if (checkpoint_is_valid(path)) return path;
  }
  return std::nullopt;
}

std::vector<std::string> set_aside_later(const std::string& folder, const std::string& newest) {
  std::vector<std::string> later;
  for (const std::string& name : checkpoints_in(folder)) {
    const std::string path = folder + "/" + name;
    if (path == newest) break;
    std::error_code error;
    fs::rename(path, path + ".damaged", error);
    if (error) throw FileError(path + ": cannot rename: " + error.message());
    later.push_back(path);
  }
  return later;
}

std::optional<std::string> checkpoint_of_step(const std::string& folder, std::int64_t step) {
  for (const std::string& name : names_in(folder)) {
    const std::string path = folder + "/" + name;
    if (fs::path(name).extension() != file_suffix || !checkpoint_is_valid(path)) continue;
    if (Hdf5Reader(path).integer_attribute("/", "step") == step) return path;
  }
  return std::nullopt;
}

void keep_as(const std::string& path, const std::string& second) {
  // No PartFile around the link: what empties an unfinished file would empty the checkpoint with it.
  const std::string part = second + ".part";
  std::error_code error;
  fs::remove(part, error);
  fs::create_hard_link(path, part, error);
  if (error) {
    PartFile copy(second);
    fs::copy_file(path, copy.part_path(), fs::copy_options::overwrite_existing, error);
    if (error) throw FileError(second + ": cannot write: " + error.message());
    copy.commit();
    return;
  }
  fs::rename(part, second, error);
  if (error) throw FileError(second + ": cannot write: " + error.message());
  fs::remove(part, error);  // still there when `second` was this very link before
}

void keep_last(const std::string& folder, std::size_t count) {
  std::vector<std::string> names = checkpoints_in(folder);
  names.erase(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min(count, names.size())));
  for (const std::string& name : names_in(folder)) {
    if (name.compare(0, file_prefix.size(), file_prefix) == 0 && name.size() > part_suffix.size() &&
        name.compare(name.size() - part_suffix.size(), part_suffix.size(), part_suffix) == 0) {
      names.push_back(name);
    }
  }
  for (const std::string& name : names) {
    std::error_code error;
    fs::remove(folder + "/" + name, error);
    if (error) throw FileError(folder + "/" + name + ": cannot remove: " + error.message());
  }
}

}  // namespace wedge
