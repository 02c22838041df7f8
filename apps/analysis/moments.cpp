// moments.cpp: finds the frames of each moment.
#include "apps/analysis/moments.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "apps/run/bed_table.hpp"
#include "io/files/frame.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

enum class Start { counts, is_of_the_one_before };

/// Adds the average over the frames in from < t <= to (or from <= t), and the last of them, where there are any. A
/// frame that comes less than `apart` [s] after another shows the same again and is left out of the average.
void add_span(std::vector<Moment>& moments, const std::string& name, TimeSpan span, Start start, bool average,
              const std::vector<double>& times, double apart) {
  const double after = start == Start::counts ? span.from - 2e-9 * std::max(1.0, span.from) : span.from;
  Moment all{name + "_mean", true, span.from, span.to, {}};
  std::int64_t last = -1;
  double before = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < times.size(); ++n) {
    const double time =
        times[n] - 1e-9 * std::max(1.0, times[n]);  // of a step that lands on the mark up to round-off
    if (time > span.to) break;
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
  moments.push_back({name, false, end, end, {last}});
  if (average) moments.push_back(all);
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

std::vector<Moment> make_moments(const AnalysedRun& run, const std::optional<TimeSpan>& span) {
  const std::vector<double> times = frame_times(run.folder);
  const double apart = 0.01 * run.scene.output.frames_every;
  std::vector<Moment> moments;
  double begin = 0;
  if (std::filesystem::exists(run.folder.beds())) {
    const std::vector<StageResult> beds = read_bed_table(run.folder.beds());
    for (std::size_t s = 0; s < beds.size() && s < run.scene.stages.size(); ++s) {
      const double end = beds[s].quantities.front().value;
      const bool timed = std::holds_alternative<UntilTime>(run.scene.stages[s].until);
      // The start of the run is of its first stage, which then has a frame even if it is of no length.
      add_span(moments, beds[s].stage, {begin, end}, s == 0 ? Start::counts : Start::is_of_the_one_before, timed,
               times, apart);
      begin = end;
    }
  }
  const std::size_t of_stages = moments.size();
  if (span) {
    add_span(moments, "window", {span->from, std::min(span->to, times.back())}, Start::counts, true, times, apart);
    if (moments.size() == of_stages)
      throw FileError(run.folder.frames() + ": no frame lies between " + number_text(span->from) + " and " +
                      (span->to < 1e300 ? number_text(span->to) + " s" : "the end") + "; they go from " +
                      number_text(times.front()) + " to " + number_text(times.back()) + " s");
  }
  if (moments.empty())
    throw FileError(run.folder.path() + ": no stage has ended yet; name a span of time: wedge analyse " +
                    run.folder.path() + " --from " + number_text(times.front()) + " --to " +
                    number_text(times.back()));
  return moments;
}

}  // namespace wedge
