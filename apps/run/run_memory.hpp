// run_memory.hpp: what the driver of a run must remember from step to step and across a restart.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernels/time_step.hpp"

namespace wedge {

struct RunMemory {
  std::int64_t stage = 0;            // index of the stage that runs, or comes next
  bool stage_begun = false;          // walls were changed, clock was set
  double stage_start = 0;            // s
  double time_step = 0;              // s, of this stage
  std::int64_t stage_start_out = 0;  // grains discharged when the stage began
  double quiet_since = -1;           // s: since when the bed is quiet; negative: it is not
  std::int64_t quiet_out = 0;        // grains discharged when it became quiet
  double last_row = -1;              // s, time of the last row of the series
  std::int64_t series_rows = 0;      // rows written on the regular grid
  std::int64_t regular_frames = 0;   // frames written on the regular grid
  std::int64_t listed_frames = 0;    // of output.at
  std::vector<double> frame_times;   // s, of every frame, by number
  Energies begin;                    // energies at the start
  double wall_seconds = 0;           // spent in earlier sessions and this one
  double stage_wall_seconds = 0;     // of them in this stage
  bool budget_doubted = false;       // it was said that the energy budget does not close
  std::string scene_name;            // for titles

  /// As key and value pairs that read back to the bit, for a checkpoint.
  std::vector<std::pair<std::string, std::string>> to_text() const;
  /// Throws FileError when a key is missing or malformed; `path` is for the message.
  static RunMemory from_text(const std::vector<std::pair<std::string, std::string>>& text, const std::string& path);
};

}  // namespace wedge
