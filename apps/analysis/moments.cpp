// moments.cpp: finds the frames of each moment.
#include "apps/analysis/moments.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "core/require.hpp"
#include "io/files/frame.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

enum class Start { counts, is_of_the_one_before };

/// A span of time that moments are made of.
struct Span {
  std::string name, stage;
  MomentRole role;
  TimeSpan time;
  Start start;
};

/// Adds the last frame in from < t <= to (or from <= t) and, where it is wanted, the mean over all of them; nothing
/// where there is none. A frame that comes less than `apart` [s] after another shows the same again and is left out
/// of the mean.
void add_span(std::vector<Moment>& moments, const Span& span, bool mean, const std::vector<double>& times,
              double apart) {
  const auto [from, to] = span.time;
  const double after = span.start == Start::counts ? from - 2e-9 * std::max(1.0, from) : from;
  Moment all{moment_name(span.name, MomentKind::mean), span.stage, MomentKind::mean, span.role, from, to, {}, {}};
  std::int64_t last = -1;
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < times.size(); ++n) {
    const double time =
        times[n] - 1e-9 * std::max(1.0, times[n]);  // of a step that lands on the mark up to round-off
    if (time > to) break;
    if (time <= after) {
      before = times[n];
      continue;
    }
    last = static_cast<std::int64_t>(n);
    if (times[n] - before < apart) continue;
    all.frames.push_back(last);
    before = times[n];
  }
  if (last < 0) return;
  if (all.frames.empty()) all.frames.push_back(last);
  const double end = times[static_cast<std::size_t>(last)];
  moments.push_back({moment_name(span.name, MomentKind::instant),
                     span.stage,
                     MomentKind::instant,
                     span.role,
                     end,
                     end,
                     {last},
                     {}});
  if (mean) moments.push_back(all);
}

/// Whether the bed flows in every stage that a span touches. A span is never at rest: the bed may only come to rest
/// in it.
bool flows(const AnalysedRun& run, const std::vector<Crossing>& crossings, TimeSpan span) {
  std::size_t stages = 0;
  for (std::size_t s = 0; s < run.stages.size(); ++s) {
    if (run.stages[s].begin >= span.to || run.stages[s].end <= span.from) continue;
    if (role_of_stage(run, s, crossings) != MomentRole::flow) return false;
    ++stages;
  }
  return stages > 0;
}

}  // namespace

std::vector<double> frame_times(const RunFolder& folder) {
  std::vector<double> times;
  for (std::int64_t n = 0; std::filesystem::exists(folder.frame("particles", n)); ++n)
    times.push_back(read_particle_header(folder.frame("particles", n)).time);
  if (times.empty()) throw FileError(folder.frames() + ": holds no frames of grains to analyse");
  const std::string missing = RunFolder::frame_name("particles", static_cast<std::int64_t>(times.size()));
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder.frames(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.size() == missing.size() && name.rfind("particles_", 0) == 0 && name > missing)
      throw FileError(folder.frames() + "/" + missing + ": is missing, but later frames are there");
  }
  return times;
}

MomentRole role_of_stage(const AnalysedRun& run, std::size_t stage, const std::vector<Crossing>& crossings) {
  const StageRecord& record = run.stages[stage];
  if (record.how == StageEnd::at_rest) return MomentRole::rest;
  const std::optional<double> opened = run.opened();
  const bool open = opened && *opened <= record.begin;
  const bool leaves = std::any_of(crossings.begin(), crossings.end(), [&](const Crossing& c) {
    return c.time > record.begin && !(c.time > record.end);
  });
  return open || leaves ? MomentRole::flow : MomentRole::other;
}

std::vector<Moment> make_moments(const AnalysedRun& run, const std::vector<Crossing>& crossings,
                                 const std::optional<TimeSpan>& span) {
  const std::vector<double> times = frame_times(run.folder);
  const double apart = 0.01 * run.scene.output.frames_every;
  std::vector<Moment> moments;
  for (std::size_t s = 0; s < run.stages.size(); ++s) {
    const StageRecord& stage = run.stages[s];
    if (!stage.ended()) continue;
    // The start of the run is of its first stage, which then has a frame even if it is of no length.
    const Start start = s == 0 ? Start::counts : Start::is_of_the_one_before;
    add_span(moments, {stage.name, stage.name, role_of_stage(run, s, crossings), {stage.begin, stage.end}, start},
             s < run.scene.stages.size() && std::holds_alternative<UntilTime>(run.scene.stages[s].until), times,
             apart);
  }
  const std::size_t of_stages = moments.size();
  if (span) {
    const TimeSpan window{span->from, std::min(span->to, times.back())};
    const MomentRole role = flows(run, crossings, window) ? MomentRole::flow : MomentRole::other;
    add_span(moments, {window_name, "", role, window, Start::counts}, true, times, apart);
    if (moments.size() == of_stages)
      throw FileError(run.folder.frames() + ": no frame lies between " + number_text(span->from) + " and " +
                      (span->to < 1e300 ? number_text(span->to) + " s" : "the end") + "; they go from " +
                      number_text(times.front()) + " to " + number_text(times.back()) + " s");
  }
  for (Moment& m : moments) m.walls = walls_present(vessel_at(run.scene, run.stages, m.end));
  if (moments.empty())
    throw FileError(run.folder.path() + ": no stage has ended yet; name a span of time: wedge analyse " +
                    run.folder.path() + " --from " + number_text(times.front()) + " --to " +
                    number_text(times.back()));
  return moments;
}

}  // namespace wedge
