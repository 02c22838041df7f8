// run_folder.cpp: whether a folder holds a run, and names of files after stages.
#include "apps/results/run_folder.hpp"

#include <filesystem>

#include "core/require.hpp"
#include "io/files/checkpoint.hpp"
#include "io/tables/provenance.hpp"

namespace wedge {

namespace fs = std::filesystem;

void RunFolder::require_run() const {
  const std::string remedy = "; name the folder that `wedge run SCENE.toml -o FOLDER` made";
  std::error_code ignored;
  if (!fs::exists(path_, ignored)) throw FileError(path_ + ": there is no such folder" + remedy);
  if (!fs::is_directory(path_, ignored)) throw FileError(path_ + ": is a file, not the folder of a run" + remedy);
  if (!fs::exists(resolved_scene(), ignored))
    throw FileError(path_ + ": is not the folder of a run: " + fs::path(resolved_scene()).filename().string() +
                    " is missing" + remedy);
}

bool RunFolder::failed_at_start() const {
  if (!fs::exists(progress())) return false;
  const Progress p = read_progress(progress());
  const bool can_go_on = fs::is_directory(checkpoints()) && newest_valid_checkpoint(checkpoints()).has_value();
  return p.state == "failed" && p.step == 0 && !can_go_on;
}

bool RunFolder::never_began() const {
  std::error_code error;
  if (fs::file_size(log(), error) != 0 || error) return false;  // the first checkpoint is the log's first line
  if (fs::exists(progress())) return false;
  for (const auto& entry : fs::directory_iterator(checkpoints(), error))
    if (entry.path().extension() == ".hdf") return false;
  return true;
}

std::string RunFolder::file_name_of(const std::string& stage) {
  std::string name;
  for (const char c : stage) {
    const auto code = static_cast<unsigned char>(c);
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                       c == '_' || c == '.' || code >= 0x80;
    char hexadecimal[4];
    std::snprintf(hexadecimal, sizeof hexadecimal, "%%%02X", code);
    name += plain ? std::string(1, c) : hexadecimal;
  }
  return name;
}

}  // namespace wedge
