// simulation.cpp: the stages of a run: begin, step until done, end.
#include "apps/run/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "apps/measure/stage_end.hpp"
#include "apps/run/interrupt.hpp"
#include "apps/run/rest.hpp"
#include "apps/run/slice_svg.hpp"
#include "apps/setup/setup.hpp"
#include "core/require.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/tables/provenance.hpp"
#include "kernels/passes/measure.hpp"

namespace wedge {
namespace {

constexpr std::int64_t look_every = 20;    // steps between looks at the wall clock, at signals and at rest
constexpr std::int64_t judge_every = 500;  // steps between looks at the energy budget
constexpr double report_every = 1;         // s of wall time between rewrites of progress.json

constexpr double deepest_insertion = 0.1;  // radii: how far a wall that a stage adds may reach into a grain

// The residual is compared with the energy lost, or with a part of the energy put in and of what lifts every grain
// by its diameter while less than that is lost: a bed that rests from the start has nothing else to compare with.
constexpr double trifling_loss = 0.1;
constexpr double doubtful_residual = 0.1;  // of the larger of the two: a warning
constexpr double garbage_residual = 0.5;   // the same: the run stops

/// Throws PhysicsError when wall w stands inside a grain.
void refuse_wall_in_grain(const State& state, int w) {
  const Particles& p = state.particles;
  for (int f = 0; f < state.vessel.feature_count(); ++f) {
    if (state.vessel.feature(f).wall != w) continue;
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
      const Vec3 x = p.position.get(i);
      const double overlap = p.radius[i] - state.vessel.proximity(f, x).distance;
      if (!(overlap > deepest_insertion * p.radius[i])) continue;
      std::ostringstream text;
      text << "the wall '" << state.vessel.wall(w).name << "' is added through grain " << p.id[i] << " at (" << x.x
           << ", " << x.y << ", " << x.z << ") m in step " << state.step << ": it reaches " << overlap
           << " m into it. Likely cause: the wall stands where the bed is; put it where no grain is.";
      throw PhysicsError(text.str());
    }
  }
}

/// Grains whose centre is above the highest wall; none without walls.
Index grains_above(const State& state) {
  double top = -std::numeric_limits<double>::infinity();
  for (int w = 0; w < state.vessel.wall_count(); ++w)
    for (const Eigen::Vector2d& point : state.vessel.wall(w).profile)
      top = std::max(top, point.y() + state.vessel.travel(w));
  if (!std::isfinite(top)) return 0;
  Index above = 0;
  for (Index i = 0; i < state.particles.count(); ++i)
    above += state.particles.position.z[static_cast<std::size_t>(i)] > top;
  return above;
}

double total_mass(const State& state) {
  double mass = 0;
  for (Index i = 0; i < state.particles.count(); ++i) mass += state.particles.mass[static_cast<std::size_t>(i)];
  return mass;
}

double seconds_since(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count();
}

}  // namespace

Simulation Simulation::begin(Scene scene, const RunFolder& folder) {
  Simulation s(std::move(scene), folder);
  s.state_ = std::make_unique<State>(make_start(*s.scene_));
  s.step_ = std::make_unique<TimeStep>(*s.scene_, *s.state_);
  s.memory_.scene_name = s.scene_->name;
  const double dt = stage_time_step(*s.scene_, *s.state_, s.scene_->stages.front());
  s.recorder_ = std::make_unique<Recorder>(folder, *s.scene_, s.state_->vessel, s.memory_, std::nullopt);
  try {
    // A bed taken over from another run brings its forces along; the first step makes its list anew.
    if (s.scene_->start_from.empty()) s.step_->start(*s.state_, dt);
  } catch (const PhysicsError& error) {
    s.fail(error,
           "Nothing is there to resume: correct the start and run it again, into the same folder if you like.");
  }
  s.memory_.begin = s.step_->energies(*s.state_);
  s.recorder_->record_due(*s.state_, *s.step_, s.memory_);
  s.save("start");  // a run killed in its first minutes can go on, and so can one whose physics fails
  return s;
}

Simulation Simulation::resume(Scene scene, const RunFolder& folder) {
  const auto newest = newest_valid_checkpoint(folder.checkpoints());
  if (!newest) throw FileError(folder.checkpoints() + ": no valid checkpoint to resume from");
  Simulation s(std::move(scene), folder);
  for (const std::string& damaged : set_aside_later(folder.checkpoints(), *newest))
    s.line_.note(damaged + ": damaged, set aside; going back to " + *newest);
  s.state_ = std::make_unique<State>(make_domain(*s.scene_));
  const CheckpointExtra extra = read_checkpoint(*newest, *s.state_);
  require_fit(*s.state_, *s.scene_, *newest);
  s.memory_ = RunMemory::from_text(extra.run_state, *newest);
  if (s.memory_.stage < 0 || s.memory_.stage > static_cast<std::int64_t>(s.scene_->stages.size()))
    throw FileError(*newest + ": the run's memory is in a stage that the scene has not");
  s.dt_ = s.memory_.time_step;
  if (!s.memory_.scene_name.empty()) s.scene_->name = s.memory_.scene_name;
  s.step_ = std::make_unique<TimeStep>(*s.scene_, *s.state_);
  s.recorder_ = std::make_unique<Recorder>(folder, *s.scene_, s.state_->vessel, s.memory_, s.state_->time);
  if (s.memory_.stage > 0 &&
      !s.memory_.stage_begun)  // a kill may have come between the checkpoint and its second name
    s.recorder_->keep_stage(s.scene_->stages[static_cast<std::size_t>(s.memory_.stage) - 1].name, s.state_->step);
  if (s.memory_.stage > 0) s.results_ = read_bed_table(folder.beds());
  s.results_.resize(std::min(s.results_.size(), static_cast<std::size_t>(s.memory_.stage)));
  s.take_up_stages();
  return s;
}

/// The record of stages as it was at the checkpoint: one that runs again has not ended.
void Simulation::take_up_stages() {
  const auto begun = static_cast<std::size_t>(memory_.stage) + (memory_.stage_begun ? 1 : 0);
  if (begun == 0) return;
  stages_ = read_stages(folder_);
  if (stages_.size() < begun) throw FileError(folder_.stages() + ": lacks a stage that the checkpoint knows");
  stages_.resize(begun);
  if (memory_.stage_begun) {
    stages_.back().end = std::numeric_limits<double>::quiet_NaN();
    stages_.back().how = StageEnd::running;
  }
  write_stages(folder_.stages(), stages_);
}

RunEnd Simulation::run(const RunLimits& limits) {
  rest_ = rest_criterion(*scene_, state_->mean_diameter);
  clock_ = std::chrono::steady_clock::now();
  if (limits.until && !finished() && state_->time >= *limits.until - 0.5 * memory_.time_step) {
    line_.note("already at " + short_number(state_->time) + " s: nothing to do until " +
               short_number(*limits.until) + " s");
    return RunEnd::until;
  }
  try {
    return run_stages(limits);
  } catch (const FileError& error) {
    fail(error);
  } catch (const PhysicsError& error) {
    const auto last = newest_valid_checkpoint(folder_.checkpoints());
    fail(error, "Last good checkpoint: " + (last ? *last : std::string("none is left")));
  }
}

RunEnd Simulation::run_stages(const RunLimits& limits) {
  while (!finished()) {
    if (const auto stopped = run_stage(limits)) {
      save(*stopped == RunEnd::interrupted ? "interrupted" : "stopped at a limit");
      report("stopped");
      return *stopped;
    }
  }
  report("finished");  // the end of the last stage left a checkpoint
  return RunEnd::finished;
}

/// Runs the present stage to its end, or says why not.
std::optional<RunEnd> Simulation::run_stage(const RunLimits& limits) {
  if (!memory_.stage_begun) memory_.time_step = stage_time_step(*scene_, *state_, stage());
  dt_ = memory_.time_step;
  stage_session_begin_ = session_seconds_;
  stage_time_begin_ = state_->time;
  if (!memory_.stage_begun) begin_stage();
  recorder_->record_due(*state_, *step_, memory_);
  std::optional<StageEnd> end;
  while (!(end = stage_end())) {
    step_->advance(*state_, dt_, steps_to_look(limits));
    recorder_->record_departures(state_->time, step_->take_departures());
    recorder_->record_due(*state_, *step_, memory_);
    if (state_->step % judge_every == 0) judge_budget();
    if (limits.until && state_->time >= *limits.until - 0.5 * dt_) {
      between_steps();
      return RunEnd::until;
    }
    if (state_->step % look_every != 0) continue;
    between_steps();
    if (interrupted()) return RunEnd::interrupted;
    if (limits.wall_time > 0 && session_seconds_ >= limits.wall_time) return RunEnd::wall_time;
  }
  between_steps();
  end_stage(*end);
  return std::nullopt;
}

/// Steps until something may have to be done between two of them: all that ends a run or a stage, or is recorded,
/// by its time. Where that is near, one.
int Simulation::steps_to_look(const RunLimits& limits) const {
  double due = recorder_->next_due(memory_);
  if (limits.until) due = std::min(due, *limits.until);
  if (stage().at_most > 0) due = std::min(due, memory_.stage_start + stage().at_most);
  if (const auto* time = std::get_if<UntilTime>(&stage().until))
    due = std::min(due, memory_.stage_start + time->duration);
  const double steps = (due - state_->time) / dt_ - 2;  // round-off of times is far below two steps
  const auto to_look = static_cast<double>(look_every - state_->step % look_every);
  return static_cast<int>(std::clamp(steps, 1.0, to_look));
}

void Simulation::begin_stage() {
  const auto numbers = [this](const std::vector<std::string>& names) {
    std::vector<int> walls;
    for (const std::string& name : names) walls.push_back(state_->vessel.wall_index(name));
    return walls;
  };
  const std::vector<int> added = numbers(stage().add);
  step_->change_walls(*state_, numbers(stage().remove), added);
  for (const int w : added) refuse_wall_in_grain(*state_, w);
  memory_.stage_begun = true;
  memory_.stage_start = state_->time;
  memory_.stage_start_out = state_->taken_out;
  memory_.quiet_since = -1;
  memory_.stage_wall_seconds = 0;
  StageRecord record;
  record.name = stage().name;
  record.begin = state_->time;
  record.walls = walls_present(state_->vessel);
  stages_.push_back(std::move(record));
  write_stages(folder_.stages(), stages_);
  std::ostringstream text;
  text << "stage " << stage().name << " begins at " << state_->time << " s with " << state_->particles.count()
       << " grains, step " << dt_ << " s";
  log(text.str());
  line_.note(text.str());
}

void Simulation::end_stage(StageEnd how) {
  const std::string name = stage().name;
  judge_budget();
  recorder_->record_series(*state_, *step_, memory_);
  recorder_->record_frame(*state_, *step_, memory_);
  const MeasuredDomain domain = describe_domain(*scene_, state_->symmetry, state_->mean_diameter);
  results_.push_back(measure_stage_end(*state_, domain, {name, memory_.stage_start, memory_.stage_wall_seconds},
                                       read_crossings(folder_.series("discharge"), domain)));
  write_bed_table(folder_.beds(), results_);
  stages_.back().end = state_->time;
  stages_.back().how = how;
  write_stages(folder_.stages(), stages_);
  std::ostringstream text;
  text << name << " ends at " << state_->time << " s after " << duration_text(memory_.stage_wall_seconds)
       << " of wall time: " << state_->particles.count() << " grains inside, " << state_->taken_out << " out";
  const bool wants_rest = std::holds_alternative<UntilAtRest>(stage().until);
  if (wants_rest && !came_to_rest()) text << "; NOT at rest: stopped by at_most";
  if (const Index above = grains_above(*state_); above > 0)
    text << "; " << above << " of them are above the walls, where nothing holds them";
  write_slice_svg(folder_.slice(name), *state_, *scene_, name);
  log("stage " + text.str());
  line_.note("stage " + text.str());
  ++memory_.stage;
  memory_.stage_begun = false;
  save(finished() ? "finished" : "end of a stage");
  recorder_->keep_stage(name, state_->step);
}

/// How the present stage has just ended; nothing while it goes on.
std::optional<StageEnd> Simulation::stage_end() {
  const double in_stage = state_->time - memory_.stage_start;
  const bool out_of_time = stage().at_most > 0 && in_stage >= stage().at_most - 0.5 * dt_;
  const auto when = [](bool over, StageEnd how) { return over ? std::optional<StageEnd>(how) : std::nullopt; };
  std::optional<StageEnd> end;
  if (const auto* time = std::get_if<UntilTime>(&stage().until))
    end = when(in_stage >= time->duration - 0.5 * dt_, StageEnd::time);
  else if (std::holds_alternative<UntilEmpty>(stage().until))
    end = when(state_->particles.count() == 0, StageEnd::empty);
  else if (const auto* out = std::get_if<UntilDischarged>(&stage().until))
    end = when(state_->taken_out - memory_.stage_start_out >= out->count, StageEnd::discharged);
  else
    end = when(out_of_time ? came_to_rest() : at_rest(), StageEnd::at_rest);
  return end ? end : when(out_of_time, StageEnd::at_most);
}

/// Whether the bed has been quiet for as long as the criterion asks.
bool Simulation::came_to_rest() const {
  return state_->particles.count() == 0 ||
         (memory_.quiet_since >= 0 && state_->time - memory_.quiet_since >= rest_.duration);
}

/// kernels know no rest: this is the run's own criterion (apps/scenes/README.md).
bool Simulation::at_rest() {
  if (state_->particles.count() == 0) return true;
  if (state_->step % look_every != 0) return false;
  const double threshold = 0.5 * total_mass(*state_) / state_->particles.count() * rest_.speed * rest_.speed;
  const bool quiet = mean_kinetic_energy(*state_) < threshold;
  if (!quiet || memory_.quiet_since < 0 || memory_.quiet_out != state_->taken_out) {
    memory_.quiet_since = quiet ? state_->time : -1;
    memory_.quiet_out = state_->taken_out;
    return false;
  }
  return came_to_rest();
}

void Simulation::between_steps() {
  const double passed = seconds_since(clock_);
  clock_ = std::chrono::steady_clock::now();
  session_seconds_ += passed;
  memory_.wall_seconds += passed;
  memory_.stage_wall_seconds += passed;
  if (session_seconds_ - last_checkpoint_ >= scene_->output.checkpoint_every) save("checkpoint");
  if (session_seconds_ - last_report_ >= report_every) report("running");
}

/// Says once when the energy budget does not close, and throws PhysicsError when it is garbage. Decided by the
/// state at fixed steps, so that it does not depend on the machine, the threads or restarts.
void Simulation::judge_budget() {
  if (!scene_->output.energy_budget) return;
  const EnergyBudget budget = energy_budget(state_->energy, memory_.begin, step_->energies(*state_));
  const double lifting = total_mass(*state_) * scene_->domain.gravity.norm() * state_->mean_diameter;
  const double scale = std::max(budget.lost, trifling_loss * (budget.put_in + lifting));
  if (!(std::abs(budget.residual) > doubtful_residual * scale)) return;
  std::ostringstream text;
  text << "at " << state_->time << " s " << budget.residual << " J are unexplained, " << budget.lost << " J of "
       << budget.put_in << " J put in were lost (residual in series/energies.csv)";
  if (std::abs(budget.residual) > garbage_residual * scale)
    throw PhysicsError("the energy budget is broken in step " + std::to_string(state_->step) + ": " + text.str() +
                       ". Likely cause: the time step of " + short_number(dt_) +
                       " s is too long (see `wedge check`), or a stage put a wall into grains.");
  if (memory_.budget_doubted) return;
  memory_.budget_doubted = true;
  log("warning: " + text.str() + ": the time step of " + short_number(dt_) + " s is too long");
  line_.note("warning: " + text.str() + ": the time step of " + short_number(dt_) + " s is too long");
}

}  // namespace wedge
