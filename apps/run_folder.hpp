// run_folder.hpp: what stands where in the folder of a run.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace wedge {

class RunFolder {
public:
  explicit RunFolder(std::string path) : path_(std::move(path)) {}

  const std::string& path() const { return path_; }
  std::string scene() const { return path_ + "/scene.toml"; }
  std::string resolved_scene() const { return path_ + "/scene.resolved.toml"; }
  std::string provenance() const { return path_ + "/provenance.json"; }
  std::string log() const { return path_ + "/run.log"; }
  std::string progress() const { return path_ + "/progress.json"; }
  std::string series(const std::string& name) const { return path_ + "/series/" + name + ".csv"; }
  std::string frames() const { return path_ + "/frames"; }
  std::string frame(const char* kind, std::int64_t number) const {
    return frames() + "/" + frame_name(kind, number);
  }
  static std::string frame_name(const char* kind, std::int64_t number) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "_%06lld.hdf", static_cast<long long>(number));
    return kind + std::string(digits);
  }
  std::string frame_series(const char* kind) const { return frames() + "/" + kind + ".hdf.series"; }
  std::string checkpoints() const { return path_ + "/checkpoints"; }
  std::string results() const { return path_ + "/results"; }
  /// One row per finished stage: what the bed was like (see bed_table.hpp).
  std::string beds() const { return results() + "/beds.csv"; }
  std::string slice(const std::string& stage) const { return results() + "/slice_" + stage + ".svg"; }

private:
  std::string path_;
};

}  // namespace wedge
