// provenance.hpp: where results come from (provenance.json) and how far a run has got (progress.json).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace wedge {

/// "0.1.0", or "0.1.0 (git description)" where the build knew one.
std::string version_text();

/// Replaces `path` by a JSON object: versions of wedge, compiler and HDF5, flags, processor model, cores, threads,
/// start time (UTC) and command line. Says nothing about user or host; of the program's path only the name is kept.
/// Throws FileError.
void write_provenance(const std::string& path, const std::vector<std::string>& command_line, int threads,
                      const std::string& precision);

/// How far a run is.
struct Progress {
  std::string state;     // "running", "finished", "stopped", "failed"
  std::string stage;     // name of the stage
  int stage_number = 0;  // from 1
  int stage_count = 0;
  double time = 0;  // s, simulated
  std::int64_t step = 0;
  double time_step = 0;     // s
  std::int64_t grains = 0;  // now in the domain
  std::int64_t discharged = 0;
  double wall_seconds = 0;  // s, spent so far
  double eta_seconds = -1;  // s, wall time still to go; negative: not known
  std::string message;      // one line, may be empty
};

/// Throw FileError.
void write_progress(const std::string& path, const Progress& progress);
Progress read_progress(const std::string& path);

}  // namespace wedge
