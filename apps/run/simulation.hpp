// simulation.hpp: a run from its first to its last stage, with all it leaves on disk.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/results/bed_table.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/results/stages.hpp"
#include "apps/run/progress_line.hpp"
#include "apps/run/recorder.hpp"
#include "apps/run/run_memory.hpp"
#include "core/require.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"
#include "kernels/time_step.hpp"

namespace wedge {

/// Why run() came back.
enum class RunEnd { finished, interrupted, wall_time, until };

struct RunLimits {
  double wall_time = 0;         // s of wall time in this session; 0: none
  std::optional<double> until;  // s of simulated time
};

class Simulation {
public:
  /// A new run into an empty or missing folder. When its physics breaks down at once, PhysicsError is thrown after
  /// a crash frame and a progress.json that says so were written, and no checkpoint.
  static Simulation begin(Scene scene, const RunFolder& folder);
  /// The run in `folder` from its newest valid checkpoint. `scene` is that of the folder.
  static Simulation resume(Scene scene, const RunFolder& folder);

  /// Runs until the last stage is done or a limit or a signal says stop; leaves a checkpoint in any case but a
  /// physics breakdown, which throws PhysicsError after a crash frame was written.
  RunEnd run(const RunLimits& limits);

  /// Whether the last stage is done: run() has nothing to do.
  bool finished() const { return memory_.stage >= static_cast<std::int64_t>(scene_->stages.size()); }
  const State& state() const { return *state_; }
  Stopwatch& stopwatch() { return step_->stopwatch(); }
  const std::vector<StageResult>& results() const { return results_; }

private:
  Simulation(Scene scene, const RunFolder& folder)
      : scene_(std::make_unique<Scene>(std::move(scene))), folder_(folder) {}

  [[noreturn]] void fail(const PhysicsError& error, const std::string& remedy);
  RunEnd run_stages(const RunLimits& limits);
  std::optional<RunEnd> run_stage(const RunLimits& limits);
  int steps_to_look(const RunLimits& limits) const;
  void begin_stage();
  void end_stage(StageEnd how);
  void take_up_stages();
  std::optional<StageEnd> stage_end();
  bool at_rest();
  bool came_to_rest() const;
  void between_steps();
  [[noreturn]] void fail(const FileError& error);
  void judge_budget();
  void save(const char* what);
  void report(const char* run_state, const std::string& message = "");
  double eta() const;
  void log(const std::string& line);
  const Stage& stage() const { return scene_->stages[static_cast<std::size_t>(memory_.stage)]; }

  std::unique_ptr<Scene> scene_;  // at a fixed place: the recorder refers to it
  RunFolder folder_;
  std::unique_ptr<State> state_;
  std::unique_ptr<TimeStep> step_;
  std::unique_ptr<Recorder> recorder_;
  RunMemory memory_;
  std::vector<StageResult> results_;
  std::vector<StageRecord> stages_;  // that have begun
  RestCriterion rest_;
  double dt_ = 0;
  ProgressLine line_;
  std::chrono::steady_clock::time_point clock_;  // of the last look at the wall clock
  double session_seconds_ = 0, last_checkpoint_ = 0, last_report_ = -1e9;
  double stage_session_begin_ = 0, stage_time_begin_ = 0;  // where this session entered the stage, for the ETA
};

}  // namespace wedge
