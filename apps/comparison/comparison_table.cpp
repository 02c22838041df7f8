// comparison_table.cpp: rows of a comparison as tables for people.
#include "apps/comparison/comparison_table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "apps/comparison/numbers_shown.hpp"
#include "apps/results/text_table.hpp"

namespace wedge {
namespace {

constexpr int digits_of_mean = 4, digits_of_distance = 3;

std::string bracketed(double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return "";
  return "[" + shown(low, digits_of_distance) + ", " + shown(high, digits_of_distance) + "]";
}

/// "cn, axis zone [m/s]": the region where it is not all, the unit where there is one.
std::string title(const ComparisonRow& row) {
  std::string text = row.quantity;
  for (const RegionKind region : {RegionKind::axis_zone, RegionKind::rest})
    if (row.region == name_of(region)) text += std::string(", ") + label_of(region);
  return row.unit.empty() || row.unit == "-" ? text : text + " [" + row.unit + "]";
}

std::string per_cent(double relative) {
  if (!std::isfinite(relative)) return "-";
  return shown(100 * relative, digits_of_distance);
}

const char* mark(const ComparisonRow& row) { return row.beyond ? "beyond" : ""; }

std::vector<std::string> words(const ComparisonRow& row) {
  return {title(row),
          shown(row.reference, digits_of_mean),
          shown(row.compared, digits_of_mean),
          shown(row.value, digits_of_distance),
          bracketed(row.interval.low, row.interval.high),
          per_cent(row.relative),
          shown(row.yardstick.median, digits_of_distance),
          bracketed(row.yardstick.low, row.yardstick.high),
          mark(row)};
}

struct Section {
  Kind kind;
  const char *name, *measure;
};
constexpr Section sections[] = {{Kind::scalar, "Scalars", "difference"},
                                {Kind::distribution, "Distributions", "Wasserstein"},
                                {Kind::profile, "Profiles over r", "rms"},
                                {Kind::map, "Maps over r and z", "rms"}};

/// The Kolmogorov-Smirnov distance stands beside the Wasserstein distance of the same distribution.
std::string section_text(const Section& section, const std::vector<const ComparisonRow*>& rows) {
  TextTable table;
  const bool distributions = section.kind == Kind::distribution;
  std::vector<std::string> line{section.name, "reference", "compared", section.measure, "95 %", "%",
                                "yardstick",  "95 %",      ""};
  if (distributions) line.insert(line.end(), {"KS", "yardstick", "95 %", ""});
  table.row(line);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    line = words(*rows[k]);
    if (distributions && k + 1 < rows.size() && rows[k + 1]->measure == Measure::kolmogorov_smirnov) {
      const ComparisonRow& ks = *rows[++k];
      line.insert(line.end(), {shown(ks.value, digits_of_distance), shown(ks.yardstick.median, digits_of_distance),
                               bracketed(ks.yardstick.low, ks.yardstick.high), mark(ks)});
    }
    table.row(line);
  }
  return table.text("  ");
}

std::string runs(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

/// "1 full vessel", "3 sectors of 90 degrees".
std::string domains_text(const RunResults& run, std::size_t n) {
  const std::string plural = n == 1 ? "" : "s", number = std::to_string(n) + " ";
  if (run.slot) return number + "slot" + plural;
  return number + (run.order == 1 ? "full vessel" + plural
                                  : "sector" + plural + " of " + angle_text(run.order) + " degrees");
}

/// What gives the yardstick the wedges that it lacks.
std::string advice(const RunSets& sets, std::size_t cut_already) {
  const auto in_vessel = static_cast<std::size_t>(sets.wedge_order / sets.reference[0].order);
  const std::string cut = "wedge analyse REF --angles " + angle_text(sets.wedge_order) + " --wedges ";
  if (in_vessel * sets.reference.size() >= fewest_wedges)
    return (cut_already > 0 ? "; cut more: " : "; cut some: ") + cut +
           std::to_string(std::min(fewest_wedges, in_vessel)) + "; or name more reference runs (seeds)";
  const std::size_t needed = (fewest_wedges + in_vessel - 1) / in_vessel;
  return "; cut all: " + cut + std::to_string(in_vessel) + "; a vessel has only " + std::to_string(in_vessel) +
         " of them: name " + std::to_string(needed) + " reference runs (seeds) or more";
}

std::string yardstick_text(const RunSets& sets) {
  const Design design = design_of(sets);
  std::vector<std::size_t> wedges;
  for (const RunResults& run : sets.reference) wedges.push_back(run.wedges.size());
  const YardstickPlan plan = plan_yardstick(design, wedges);
  if (!plan.why_not.empty()) {
    return "not known: " + plan.why_not + (!design.alike && sets.wedge_order > 0 ? advice(sets, plan.pieces) : "");
  }
  const std::string piece = design.alike ? "run" : "wedge";
  std::string text = runs(sets.compared.size(), piece) + " against " + domains_text(sets.reference[0], plan.runs);
  text += ", drawn " + std::to_string(repetitions) + " times from the " +
          (design.alike ? "" : runs(plan.pieces, piece) + " of the ") + runs(plan.runs, "reference run");
  if (plan.one_run) text += ", which knows nothing of other seeds";
  return text;
}

}  // namespace

std::string sets_text(const RunSets& sets) {
  std::string text = "\nAnalysis: " + domains_text(sets.reference[0], sets.reference.size()) + " and " +
                     domains_text(sets.compared[0], sets.compared.size()) + "\n";
  if (has_axis_zone(sets)) {
    const double radius = axis_zone_radius(sets), d = sets.compared[0].diameter;
    text += radius > 0 ? "axis zone: r < " + shown(axis_zone_arc, 1) + " d / theta = " + shown(radius / d, 3) +
                             " d = " + shown(radius, 4) + " m\n"
                       : "summary.json is missing: no axis zone and rest of profiles and maps\n";
  }
  return text + "yardstick: " + yardstick_text(sets) + "\n";
}

std::string moment_text(const std::string& moment, const std::vector<ComparisonRow>& rows, bool at_rest) {
  std::string text = "\nmoment " + moment + "\n";
  if (at_rest) text += "  velocities: at rest, none is resolved\n";
  for (const Section& section : sections) {
    std::vector<const ComparisonRow*> of_section;
    for (const ComparisonRow& row : rows)
      if (row.kind == section.kind) of_section.push_back(&row);
    if (!of_section.empty()) text += section_text(section, of_section);
  }
  return text;
}

std::string legend_text(const std::vector<ComparisonRow>& rows) {
  std::set<Basis> bases;
  std::size_t known = 0, beyond = 0;
  for (const ComparisonRow& row : rows) {
    if (std::isfinite(row.value)) bases.insert(row.interval.basis);
    known += std::isfinite(row.yardstick.high) ? 1 : 0;
    beyond += row.beyond ? 1 : 0;
  }
  std::string text = "\n95 % after a value: ";
  const char* const says[] = {"bootstrap over seeds",
                              "bootstrap over the wedges of the reference runs (fewer than 5 runs in a set)",
                              "from spread and own intervals of the runs (fewer than 5 in a set, no wedges)",
                              "not known where nothing stands (fewer than 5 runs in a set, no wedges)"};
  std::size_t said = 0;
  for (const Basis basis : bases) text += (said++ > 0 ? "; " : "") + std::string(says[static_cast<int>(basis)]);
  text +=
      ".\n%: of the reference's value (scalars), standard deviation (distributions), root mean square (profiles "
      "and maps).\n"
      "Noise alone makes a distance larger than 0; the interval after it is that of the distance without noise.\n"
      "Yardstick: what noise alone makes of sets of the full model as large as these. Beyond: outside of its 95 "
      "%.\n";
  if (known > 0)
    text += std::to_string(beyond) + " of " + std::to_string(known) +
            " rows with a yardstick are beyond; where the sets do not differ one in twenty is, by chance.\n";
  return text;
}

std::string judgement_text(const Judgement& judgement, const std::string& tolerance_file) {
  std::string text = "\n" + tolerance_file + ": ";
  if (judgement.breaches.empty()) return text + "all " + runs(judgement.judged, "row") + " within tolerance\n";
  text += "of " + runs(judgement.judged, "row") + " outside of tolerance:\n";
  TextTable table;
  for (const Breach& breach : judgement.breaches)
    table.row({std::string(name_of(breach.row->kind)) + " " + breach.row->moment + ": " + title(*breach.row) +
                   ", " + name_of(breach.row->measure),
               breach.says});
  return text + table.text("  ");
}

}  // namespace wedge
