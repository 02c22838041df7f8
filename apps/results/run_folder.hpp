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
  /// The checkpoint of a stage's end.
  std::string stage_checkpoint(const std::string& stage) const {
    return checkpoints() + "/stage_" + file_name_of(stage) + ".hdf";
  }
  std::string results() const { return path_ + "/results"; }
  /// One row per stage that has begun: its times and walls (see stages.hpp).
  std::string stages() const { return results() + "/stages.csv"; }
  /// One row per finished stage: what the bed was like (see bed_table.hpp).
  std::string beds() const { return results() + "/beds.csv"; }
  std::string slice(const std::string& stage) const { return results() + "/slice_" + file_name_of(stage) + ".svg"; }

  /// Throws FileError, which says what is missing and what the folder of a run is, unless this is one.
  void require_run() const;
  /// Whether a run broke down here before its first step: nothing is there to go on with.
  bool failed_at_start() const;
  /// Whether a run was killed here before it had written anything to go on with. Pre: nobody runs in it.
  bool never_began() const;
  /// A stage's name as part of the name of a file: what a file system may refuse, and blanks, as %XX.
  static std::string file_name_of(const std::string& stage);

private:
  std::string path_;
};

}  // namespace wedge
