// recorder.cpp: series, frames and checkpoints of a run, and cutting them back when it resumes.
#include "apps/run/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/files/frame.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/file_series.hpp"
#include "kernels/passes/measure.hpp"

namespace wedge {
namespace {

namespace fs = std::filesystem;
constexpr double series_per_second = 200;  // rows per simulated second when the scene does not say

std::vector<SeriesColumn> energy_columns(bool budget) {
  std::vector<SeriesColumn> c{{"time", "s"}, {"step", ""}};
  for (const char* name :
       {"kinetic", "rotational", "elastic_normal", "elastic_tangential", "potential", "carried_in", "carried_out"})
    c.push_back({name, "J"});
  if (budget)
    for (const char* name : {"normal_damping", "tangential_damping", "sliding", "rolling", "axis", "wall_work",
                             "history_coupling", "residual"})
      c.push_back({name, "J"});
  return c;
}

std::vector<SeriesColumn> wall_columns(const Vessel& vessel) {
  std::vector<SeriesColumn> c{{"time", "s"}};
  for (int w = 0; w < vessel.wall_count(); ++w) {
    for (const char* part : {" fx", " fy", " fz"}) c.push_back({vessel.wall(w).name + part, "N"});
    for (const char* part : {" tx", " ty", " tz"}) c.push_back({vessel.wall(w).name + part, "N m"});
  }
  return c;
}

void make_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path + ": cannot make the folder: " + error.message());
}

}  // namespace

Recorder::Recorder(const RunFolder& folder, const Scene& scene, const Vessel& vessel, const RunMemory& memory,
                   std::optional<double> resume_time)
    : folder_(folder),
      scene_(scene),
      series_every_(scene.output.series_every > 0 ? scene.output.series_every : 1 / series_per_second) {
  for (const std::string& path :
       {folder.path() + "/series", folder.frames(), folder.checkpoints(), folder.results()})
    make_folder(path);
  open_series(vessel, memory, resume_time);
  if (!resume_time) return;
  forget_later_frames(memory);
  forget_later_stages(memory);
}

void Recorder::open_series(const Vessel& vessel, const RunMemory& memory, std::optional<double> resume_time) {
  const auto open = [&](const char* name, const std::vector<SeriesColumn>& columns, double last) {
    return resume_time ? SeriesFile::reopen(folder_.series(name), columns, last)
                       : SeriesFile::create(folder_.series(name), columns);
  };
  // A row of the checkpoint's own time may have been written after it: the run's memory, not the clock, tells.
  const double row = memory.last_row;
  energies_.emplace(open("energies", energy_columns(scene_.output.energy_budget), row));
  ledger_.emplace(open("ledger", {{"time", "s"}, {"in", ""}, {"inside", ""}, {"out", ""}}, row));
  walls_.emplace(open("walls", wall_columns(vessel), row));
  const double departure = resume_time.value_or(0);  // departures are written before a checkpoint
  discharge_.emplace(open("discharge",
                          {{"time", "s"},
                           {"crossed", "s"},
                           {"id", ""},
                           {"layer", ""},
                           {"x", "m"},
                           {"y", "m"},
                           {"z", "m"},
                           {"vx", "m/s"},
                           {"vy", "m/s"},
                           {"vz", "m/s"},
                           {"mass", "kg"}},
                          departure));
}

void Recorder::forget_later_frames(const RunMemory& memory) {
  for (const char* kind : {"particles", "contacts"}) {
    for (auto n = static_cast<std::int64_t>(memory.frame_times.size());; ++n) {
      std::error_code ignored;
      if (!fs::remove(folder_.frame(kind, n), ignored)) break;
    }
  }
  list_frames(memory);
}

/// A stage that runs again has not ended: nobody shall start from its earlier end meanwhile.
void Recorder::forget_later_stages(const RunMemory& memory) {
  for (auto s = static_cast<std::size_t>(memory.stage); s < scene_.stages.size(); ++s) {
    std::error_code ignored;
    fs::remove(folder_.stage_checkpoint(scene_.stages[s].name), ignored);
  }
}

void Recorder::record_due(State& state, const TimeStep& step, RunMemory& memory) {
  const double now = state.time * (1 + 1e-12);  // a step that lands on the mark up to round-off has reached it
  if (now >= static_cast<double>(memory.series_rows) * series_every_) {
    record_series(state, step, memory);
    memory.series_rows = static_cast<std::int64_t>(now / series_every_) + 1;
  }
  bool frame = false;
  const double every = scene_.output.frames_every;
  if (every > 0 && now >= static_cast<double>(memory.regular_frames) * every) {
    memory.regular_frames = static_cast<std::int64_t>(now / every) + 1;
    frame = true;
  }
  const auto& at = scene_.output.frames_at;
  while (memory.listed_frames < static_cast<std::int64_t>(at.size()) &&
         now >= at[static_cast<std::size_t>(memory.listed_frames)]) {
    ++memory.listed_frames;
    frame = true;
  }
  if (frame) record_frame(state, step, memory);
}

double Recorder::next_due(const RunMemory& memory) const {
  double due = static_cast<double>(memory.series_rows) * series_every_;
  if (scene_.output.frames_every > 0)
    due = std::min(due, static_cast<double>(memory.regular_frames) * scene_.output.frames_every);
  const auto& at = scene_.output.frames_at;
  if (memory.listed_frames < static_cast<std::int64_t>(at.size()))
    due = std::min(due, at[static_cast<std::size_t>(memory.listed_frames)]);
  return due;
}

void Recorder::record_series(const State& state, const TimeStep& step, RunMemory& memory) {
  if (memory.last_row == state.time) return;
  memory.last_row = state.time;
  const Energies e = step.energies(state);
  const EnergyLedger& l = state.energy;
  std::vector<double> row{state.time,       static_cast<double>(state.step),
                          e.kinetic,        e.rotational,
                          e.elastic_normal, e.elastic_tangential,
                          e.potential,      l.carried_in,
                          l.carried_out};
  if (scene_.output.energy_budget)
    for (const double x : {l.normal_damping, l.tangential_damping, l.sliding, l.rolling, l.axis, l.wall_work,
                           history_coupling(l, memory.begin, e), residual(l, memory.begin, e)})
      row.push_back(x);
  energies_->append(row);
  ledger_->append({state.time, static_cast<double>(state.put_in), static_cast<double>(state.particles.count()),
                   static_cast<double>(state.taken_out)});
  row = {state.time};
  for (const WallLoad& load : wall_loads(state))
    for (const Vec3& v : {load.force, load.torque}) row.insert(row.end(), {v.x, v.y, v.z});
  walls_->append(row);
}

void Recorder::record_departures(double now, std::vector<Departure> departures) {
  std::sort(departures.begin(), departures.end(),
            [](const Departure& a, const Departure& b) { return a.id < b.id; });
  for (const Departure& d : departures)
    discharge_->append({now, d.time, static_cast<double>(d.id), static_cast<double>(d.layer), d.position.x,
                        d.position.y, d.position.z, d.velocity.x, d.velocity.y, d.velocity.z, d.mass});
}

void Recorder::list_frames(const RunMemory& memory) const {
  for (const char* kind : {"particles", "contacts"}) {
    if (!scene_.output.contacts && kind[0] == 'c') continue;
    std::vector<SeriesEntry> entries;
    for (std::size_t n = 0; n < memory.frame_times.size(); ++n)
      entries.push_back({RunFolder::frame_name(kind, static_cast<std::int64_t>(n)), memory.frame_times[n]});
    write_file_series(folder_.frame_series(kind), entries);
  }
}

void Recorder::record_frame(const State& state, const TimeStep& step, RunMemory& memory) {
  FrameInfo info;
  info.scene_text = scene_.text;
  info.precision = scene_.output.precision;
  info.number = static_cast<std::int64_t>(memory.frame_times.size());
  write_particle_frame(folder_.frame("particles", info.number), state, info);
  if (scene_.output.contacts)
    write_contact_frame(folder_.frame("contacts", info.number), state, step.contact_forces(state), info);
  memory.frame_times.push_back(state.time);
  list_frames(memory);
}

void Recorder::record_checkpoint(const State& state, const RunMemory& memory) {
  for (auto* series : {&energies_, &ledger_, &discharge_, &walls_}) (*series)->sync();
  const CheckpointExtra extra{scene_.text, resolved_scene(scene_), memory.to_text()};
  write_checkpoint(checkpoint_path(folder_.checkpoints(), state.step), state, extra);
  keep_last(folder_.checkpoints(), 2);
}

void Recorder::keep_stage(const std::string& stage, std::int64_t step) {
  keep_as(checkpoint_path(folder_.checkpoints(), step), folder_.stage_checkpoint(stage));
}

std::string Recorder::record_crash(const State& state) {
  const std::string path = folder_.frames() + "/crash_particles.hdf";
  FrameInfo info;
  info.scene_text = scene_.text;
  info.precision = FramePrecision::double_precision;
  info.number = -1;
  write_particle_frame(path, state, info);
  return path;
}

}  // namespace wedge
