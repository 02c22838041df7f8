// simulation_report.cpp: what a run tells and keeps while it goes: checkpoints, progress, its log, and how it
// failed.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "apps/run/simulation.hpp"
#include "core/require.hpp"
#include "io/files/checkpoint.hpp"
#include "io/tables/provenance.hpp"

namespace wedge {
namespace {

constexpr double least_to_judge = 1;  // s of wall time from which on a rate or a forecast is told

}  // namespace

/// Leaves the grains as they are and the reason in run.log and progress.json, then throws on with both.
void Simulation::fail(const PhysicsError& error, const std::string& remedy) {
  const std::string text = std::string(error.what()) +
                           "\nThe grains at that moment: " + recorder_->record_crash(*state_) + "\n" + remedy;
  report("failed", text.substr(0, text.find('\n')));
  log("physics error: " + text);
  throw PhysicsError(text);
}

/// A file could not be written: says so where it can, then throws on with what to do.
void Simulation::fail(const FileError& error) {
  std::string text = error.what();
  try {
    const auto last = newest_valid_checkpoint(folder_.checkpoints());
    text += "\nLast good checkpoint: " + (last ? *last : std::string("none is left"));
    if (last) text += "\nWhen the cause is gone, go on with: wedge resume " + folder_.path();
    log("file error: " + text);
    report("failed", error.what());
  } catch (const FileError&) {  // the disk that is full is this one
  }
  throw FileError(text);
}

void Simulation::save(const char* what) {
  recorder_->record_departures(state_->time, step_->take_departures());
  recorder_->record_checkpoint(*state_, memory_);
  last_checkpoint_ = session_seconds_;
  std::ostringstream text;
  text << what << ": checkpoint at step " << state_->step << ", " << state_->time << " s";
  log(text.str());
}

/// Wall time still to go in this stage and, where they are of known length, the next ones [s]; negative: not known.
double Simulation::eta() const {
  const double done = state_->time - stage_time_begin_, spent = session_seconds_ - stage_session_begin_;
  if (done <= 0 || spent < least_to_judge) return -1;
  double left = 0;
  for (auto n = static_cast<std::size_t>(memory_.stage); n < scene_->stages.size(); ++n) {
    const auto* time = std::get_if<UntilTime>(&scene_->stages[n].until);
    if (!time) return -1;
    left +=
        time->duration - (n == static_cast<std::size_t>(memory_.stage) ? state_->time - memory_.stage_start : 0);
  }
  return left * spent / done;
}

void Simulation::report(const char* run_state, const std::string& message) {
  last_report_ = session_seconds_;
  const bool over = finished();
  Progress p;
  p.state = run_state;
  p.stage = over ? scene_->stages.back().name : stage().name;
  p.stage_count = static_cast<int>(scene_->stages.size());
  p.stage_number = std::min(static_cast<int>(memory_.stage) + 1, p.stage_count);
  p.time = state_->time;
  p.step = state_->step;
  p.time_step = dt_;
  p.grains = state_->particles.count();
  p.discharged = state_->taken_out;
  p.wall_seconds = memory_.wall_seconds;
  p.eta_seconds = over ? 0 : eta();
  p.message = message;
  write_progress(folder_.progress(), p);
  if (session_seconds_ < least_to_judge) return;  // of so short a time a rate would say little
  const double spent = session_seconds_ - stage_session_begin_;
  const double steps = dt_ > 0 ? (state_->time - stage_time_begin_) / dt_ : 0;
  line_.show(p, spent >= least_to_judge ? steps * state_->particles.count() / spent : 0, session_seconds_);
}

void Simulation::log(const std::string& line) {
  std::ofstream file(folder_.log(), std::ios::app);
  file << line << '\n';
  if (!file.flush()) throw FileError(folder_.log() + ": cannot write");
}

}  // namespace wedge
