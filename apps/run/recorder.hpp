// recorder.hpp: what a run leaves on disk while it goes: series, frames, checkpoints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/results/run_folder.hpp"
#include "apps/run/run_memory.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "io/tables/series.hpp"
#include "kernels/time_step.hpp"

namespace wedge {

class Recorder {
public:
  /// Makes the folders and empty series of a new run, or cuts those of an old one back to `resume_time` [s] and to
  /// the frames and stages in `memory`. Throws FileError.
  Recorder(const RunFolder& folder, const Scene& scene, const Vessel& vessel, const RunMemory& memory,
           std::optional<double> resume_time);

  /// Rows and frames that are due at the state's time. Pre: between two steps.
  void record_due(State& state, const TimeStep& step, RunMemory& memory);
  /// A row of every series now, unless this moment has one.
  void record_series(const State& state, const TimeStep& step, RunMemory& memory);
  /// A frame now, whatever the schedule.
  void record_frame(const State& state, const TimeStep& step, RunMemory& memory);
  /// Appends grains that have left since the last call, by `now` [s], to discharge.csv.
  void record_departures(double now, std::vector<Departure> departures);
  /// Writes a checkpoint and keeps the last two. Pre: departures were recorded.
  void record_checkpoint(const State& state, const RunMemory& memory);
  /// Keeps the last checkpoint, of this step, as that of the stage's end.
  void keep_stage(const std::string& stage, std::int64_t step);
  /// The grains as they are when the physics broke down: frames/crash_particles.hdf.
  std::string record_crash(const State& state);

  /// The time [s] of the next row or frame of the schedule; infinity when there is none.
  double next_due(const RunMemory& memory) const;
  double series_every() const { return series_every_; }

private:
  void open_series(const Vessel& vessel, const RunMemory& memory, std::optional<double> resume_time);
  void forget_later_frames(const RunMemory& memory);
  void forget_later_stages(const RunMemory& memory);
  void list_frames(const RunMemory& memory) const;

  RunFolder folder_;
  const Scene& scene_;
  double series_every_;  // s
  std::optional<SeriesFile> energies_, ledger_, discharge_, walls_;
};

}  // namespace wedge
