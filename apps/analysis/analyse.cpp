// analyse.cpp: streams over the frames of a run, adds them up moment by moment, and writes what was found.
#include "apps/analysis/analyse.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>

#include "apps/analysis/results.hpp"
#include "core/parallel.hpp"
#include "core/time_scales.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/diagnostics.hpp"

namespace wedge {
namespace {

using SumsOfMoments = std::vector<std::vector<std::unique_ptr<PartSums>>>;  // by moment, by part

/// Cells d wide and 2 d high from the ground to a little above the bed of the first frame.
FieldGrid make_grid(const AnalysedRun& run, const Bed& first) {
  const double d = run.diameter;
  std::vector<double> heights;
  for (const BedGrain& g : first.grains)
    if (g.in_bed) heights.push_back(g.position.z);
  double top = first.ground + 2 * d;
  if (!heights.empty()) {
    const auto place =
        heights.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(heights.size() - 1));
    std::nth_element(heights.begin(), place, heights.end());
    top = std::max(top, *place + 4 * d);
  }
  FieldGrid grid;
  grid.left = run.left;
  grid.low = first.ground;
  grid.width = d;
  grid.height = 2 * d;
  const double across = run.slot ? 2 * run.radius : run.radius;
  grid.columns = std::max(1, static_cast<int>(std::ceil(across / d - 1e-6)));
  grid.rows = static_cast<int>(std::ceil((top - grid.low) / grid.height));
  grid.smoothing = d;
  grid.slot_width = run.slot ? run.scene.domain.slot_width : 0;
  return grid;
}

double mean_mass(const Bed& bed) {
  double sum = 0;
  for (const BedGrain& g : bed.grains) sum += g.mass;
  return bed.grains.empty() ? 1 : sum / static_cast<double>(bed.grains.size());
}

/// Instants at whose cut no grain lies.
struct EmptyCuts {
  std::string moments;  // names with commas between
  double height = 0;    // m, of the last of them
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();  // m, between which centres of the bed lie at any of them

  void note(const std::string& moment, double at, const Bed& bed) {
    moments += (moments.empty() ? "" : ", ") + moment;
    height = at;
    for (const BedGrain& g : bed.grains) {
      if (!g.in_bed) continue;
      low = std::min(low, g.position.z);
      high = std::max(high, g.position.z);
    }
  }
};

struct Pictures {
  std::string slice, network, cut;
  EmptyCuts empty;
};

std::string empty_cuts_text(const EmptyCuts& empty, double reach) {
  const std::string text = "cut.csv: no grain lies within " + short_number(reach) + " m of the height " +
                           short_number(empty.height) + " m at " + empty.moments;
  return text + (empty.high < empty.low ? "; there is no grain in the bed"
                                        : "; centres of the bed's grains lie between " + short_number(empty.low) +
                                              " and " + short_number(empty.high) + " m");
}

/// Which angles have no room for as many wedges as were asked for, and how many they have; "" when all have it.
std::string wedges_left_out(const PartRequest& request) {
  std::string text;
  for (const int order : request.orders)
    if (order < request.wedges)
      text += (text.empty() ? "" : ", ") + std::to_string(order) + " of " + angle_text(order);
  if (text.empty()) return "";
  return "wedges: of the " + std::to_string(request.wedges) + " asked for a vessel has room for " + text +
         " degrees";
}

/// Reads the frames that some moment wants, once each.
SumsOfMoments add_up(const AnalysedRun& run, const AnalysisRequest& request, const std::vector<Moment>& moments,
                     Pictures& pictures) {
  std::set<std::int64_t> wanted;
  for (const Moment& m : moments) wanted.insert(m.frames.begin(), m.frames.end());
  const std::vector<Part> parts = make_parts(run, request.parts);
  SumsOfMoments sums(moments.size());
  for (const std::int64_t number : wanted) {
    const Bed bed = read_bed(run, number);
    if (sums.front().empty()) {
      const FieldGrid grid = make_grid(run, bed);
      for (auto& of_moment : sums)
        for (const Part& part : parts)
          of_moment.push_back(std::make_unique<PartSums>(run, part, grid, mean_mass(bed)));
    }
    std::vector<PartSums*> wanting;
    for (std::size_t m = 0; m < moments.size(); ++m) {
      if (!std::binary_search(moments[m].frames.begin(), moments[m].frames.end(), number)) continue;
      for (auto& part : sums[m]) wanting.push_back(part.get());
      if (moments[m].kind == MomentKind::mean) continue;
      append_slice(pictures.slice, pictures.network, moments[m].name, slice_picture(run, bed));
      const double height = request.cut.value_or(bed.ground + 5 * run.diameter);
      const std::vector<PictureGrain> cut = cut_picture(run, bed, height);
      append_cut(pictures.cut, moments[m].name, cut);
      if (cut.empty()) pictures.empty.note(moments[m].name, height, bed);
    }
    // Each adds to its own sums, one alone over its own blocks.
    for_each_block(static_cast<Index>(wanting.size()),
                   [&](Index k) { wanting[static_cast<std::size_t>(k)]->add(bed); });
  }
  return sums;
}

/// Packing of the last instant before the orifice opened; nan without one.
double packing_before_opening(const AnalysedRun& run, const std::vector<Moment>& moments, const SumsOfMoments& sums,
                              std::size_t part) {
  double packing = std::nan(""), latest = -1;
  const std::optional<double> opening = run.opened();
  for (std::size_t m = 0; opening && m < moments.size(); ++m) {
    if (moments[m].kind == MomentKind::mean || moments[m].end > *opening + 1e-9 || moments[m].end < latest)
      continue;
    latest = moments[m].end;
    packing = sums[m][part]->mean("packing");
  }
  return packing;
}

/// Adds what follows from the discharge in the moment's span of time.
void add_discharge(PartResult& result, const AnalysedRun& run, const Moment& moment,
                   const std::vector<Crossing>& crossings, double packing_before) {
  const std::optional<double> opening = run.opened();
  if (moment.kind == MomentKind::instant || !run.scene.domain.outlet_height || !opening || moment.end <= *opening)
    return;
  const Part& part = result.sums->part();
  const double begin = std::max(moment.begin, *opening);
  const Estimate rate = discharge_rate(crossings, part, begin, moment.end);
  result.scalars.push_back(scalar("discharge_rate", rate));
  if (orifice_diameter(run.scene) > 0 && result.sums->mean("grains") > 0)
    result.scalars.push_back(scalar("arched", arched(crossings, part, begin, moment.end) ? 1 : 0));
  const Estimate beverloo = beverloo_rate(run, packing_before);
  result.scalars.push_back(scalar("beverloo_low", beverloo.low));
  result.scalars.push_back(scalar("beverloo_high", beverloo.high));
  const double grain = numbers::pi / 6 * std::pow(run.diameter, 3);
  result.plug_speed = rate.value * grain / (result.sums->mean("packing") * run.cross_section());
  if (!(result.plug_speed > 0)) return;
  const std::vector<double> volumes = zone_volumes(*result.sums, result.plug_speed);
  const char* const names[] = {"zone_stagnant", "zone_plug", "zone_converging"};
  for (std::size_t k = 0; k < volumes.size(); ++k) result.scalars.push_back(scalar(names[k], volumes[k]));
}

}  // namespace

AnalysisReport analyse(const AnalysisRequest& request) {
  const AnalysedRun run = open_run(request.folder);
  AnalysisReport report;
  report.full_vessel = run.scene.domain.kind == DomainKind::full;
  const std::vector<Crossing> crossings = read_crossings(run.folder.series("discharge"), run);
  report.moments = make_moments(run, crossings, request.span);
  Pictures pictures;
  const SumsOfMoments sums = add_up(run, request, report.moments, pictures);
  std::vector<MomentResult> results;
  std::set<std::int64_t> frames;
  for (std::size_t m = 0; m < report.moments.size(); ++m) {
    frames.insert(report.moments[m].frames.begin(), report.moments[m].frames.end());
    MomentResult result{report.moments[m], {}};
    for (std::size_t p = 0; p < sums[m].size(); ++p) {
      PartResult part{sums[m][p].get(), sums[m][p]->scalars(), 0};
      add_discharge(part, run, report.moments[m], crossings, packing_before_opening(run, report.moments, sums, p));
      result.parts.push_back(std::move(part));
    }
    results.push_back(std::move(result));
  }
  report.frames = frames.size();
  std::error_code ignored;  // a folder that cannot be made shows when the first file is written
  std::filesystem::create_directories(run.folder.results(), ignored);
  const auto write = [&](const char* name, const std::string& text) {
    if (text.empty()) return;
    report.files.push_back(run.folder.results() + "/" + name);
    write_text_file_atomically(report.files.back(), text);
  };
  write("scalars.csv", scalars_csv(results));
  write("distributions.csv", distributions_csv(results));
  write("radial.csv", radial_csv(results));
  write("map.csv", map_csv(results));
  write("slice.csv", pictures.slice);
  write("network.csv", pictures.network);
  write("cut.csv", pictures.cut);
  double until = 0;
  for (const Moment& m : report.moments) until = std::max(until, m.end);
  if (run.scene.domain.outlet_height) write("flow.csv", flow_csv(run, crossings, until));
  write("summary.json", summary_json(run, results));
  if (!pictures.empty.moments.empty()) report.notes.push_back(empty_cuts_text(pictures.empty, run.diameter));
  const std::string left_out = wedges_left_out(request.parts);
  if (report.full_vessel && !left_out.empty()) report.notes.push_back(left_out);
  return report;
}

}  // namespace wedge
