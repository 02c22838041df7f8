// compare.cpp: wedge compare: two sets of runs, their beds stage by stage and their analyses.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>
#include <sstream>

#include "apps/commands/commands.hpp"
#include "apps/comparison/bed_comparison.hpp"
#include "apps/comparison/comparison_table.hpp"
#include "apps/results/run_folder.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

std::string runs_text(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) text += (text.empty() ? "" : ", ") + folder;
  return text + (folders.size() == 1 ? "  (1 run)" : "  (" + std::to_string(folders.size()) + " runs)");
}

/// The runs that are analysed, and what of the others is missing.
struct AnalysedRuns {
  std::vector<RunResults> runs;
  std::string says;
};
AnalysedRuns analysed_runs(const std::vector<std::string>& folders, bool demanded) {
  AnalysedRuns found;
  for (const std::string& folder : folders) {
    RunResults run = read_domain(folder);
    if (analysed(run)) {
      for (const std::string& file : run.missing)
        found.says += folder + ": there is no results/" + file + ": its quantities are left out for this run\n";
      found.runs.push_back(std::move(run));
      continue;
    }
    const std::string says = folder + ": has not been analysed; run: wedge analyse " + folder;
    if (demanded) throw FileError(says);
    found.says += says + '\n';
  }
  return found;
}

int usage(const std::string& problem) {
  std::cerr << "wedge: " << problem << '\n';
  return exit_code::usage;
}

/// What is wrong with a set whose runs have different domains; "" for a sound one.
std::string mixture(const std::vector<RunResults>& runs, const std::string& set) {
  for (const RunResults& run : runs)
    if (run.order != runs[0].order || run.slot != runs[0].slot)
      return "the " + set + " runs have different domains: " + runs[0].folder + " (" +
             (runs[0].slot ? "slot" : angle_text(runs[0].order) + " degrees") + ") and " + run.folder + " (" +
             (run.slot ? "slot" : angle_text(run.order) + " degrees") + "); compare one angle at a time";
  return "";
}

/// What is wrong with a set that has one folder twice, by whatever names: its run would count as two; "" for a
/// sound one.
std::string repetition(const std::vector<std::string>& folders, const std::string& set) {
  std::map<std::filesystem::path, std::string> seen;  // names by place
  for (const std::string& folder : folders) {
    std::error_code unknown;  // of what is no folder there is more to say later
    const std::filesystem::path place = std::filesystem::canonical(folder, unknown);
    if (unknown) continue;
    const auto [first, is_new] = seen.emplace(place, folder);
    if (!is_new) return "the " + set + " runs name one run twice: " + first->second + " and " + folder;
  }
  return "";
}

/// The resolved scene without the tables that say how it was run and what was written: what decides the motion, the
/// seed among it.
std::string motion_of(const std::string& folder) {
  std::istringstream text(read_text_file(RunFolder(folder).resolved_scene()));
  std::string line, kept;
  bool keeps = true;
  while (std::getline(text, line)) {
    if (!line.empty() && line[0] == '[') keeps = line != "[run]" && line != "[output]";
    if (keeps) kept += line + '\n';
  }
  return kept;
}

/// A line for runs of a set whose scene and seed are the same: most likely one run, done again or copied.
std::string same_seed_warnings(const std::vector<std::string>& folders) {
  std::map<std::string, std::vector<std::string>> runs;  // by scene
  for (const std::string& folder : folders) runs[motion_of(folder)].push_back(folder);
  std::string text;
  for (const auto& [scene, same] : runs) {
    if (same.size() < 2) continue;
    text += "warning: ";
    for (std::size_t k = 0; k < same.size(); ++k) text += (k > 0 ? ", " : "") + same[k];
    text += ": the same scene and seed; they count as " + std::to_string(same.size()) +
            " seeds but carry the information of one\n";
  }
  return text;
}

/// 360 degrees / angle of the wedges that serve: those of the compared sector or, for two sets of full vessels,
/// which need them for intervals only, the widest there are.
int wedges_wanted(const RunSets& sets) {
  const RunResults &reference = sets.reference[0], &compared = sets.compared[0];
  if (reference.slot || compared.slot || reference.order > 1) return 0;
  return compared.order > 1 ? compared.order : widest_wedges(reference);
}

int compare_analyses(RunSets& sets, const CompareOptions& options) {
  sets.wedge_order = wedges_wanted(sets);
  for (auto* set : {&sets.reference, &sets.compared})
    for (RunResults& run : *set) read_results(run, sets.wedge_order);
  std::vector<std::string> moments = common_moments(sets);
  if (!options.moment.empty()) {
    if (std::find(moments.begin(), moments.end(), options.moment) == moments.end())
      return usage("--moment " + options.moment + ": not both sets have it; " +
                   suggestion(options.moment, moments));
    moments = {options.moment};
  }
  std::cout << sets_text(sets);
  if (moments.empty()) std::cout << "the analyses have no moment in common\n";
  std::vector<ComparisonRow> rows;
  for (const std::string& moment : moments) {
    const std::vector<ComparisonRow> of_moment = compare(sets, moment);
    std::cout << moment_text(moment, of_moment, velocities_at_rest(sets, moment)) << std::flush;
    rows.insert(rows.end(), of_moment.begin(), of_moment.end());
  }
  std::cout << legend_text(rows);
  if (!options.csv.empty()) write_text_file_atomically(options.csv, comparison_csv(rows));
  if (options.tolerance.empty()) return exit_code::ok;
  const Judgement judgement = judge(rows, read_tolerances(options.tolerance));
  std::cout << judgement_text(judgement, options.tolerance);
  return judgement.breaches.empty() ? exit_code::ok : exit_code::tolerance;
}

}  // namespace

int command_compare(const std::vector<std::string>& reference, const std::vector<std::string>& with,
                    const CompareOptions& options) {
  if (!options.tolerance.empty())
    read_tolerances(options.tolerance);  // its mistakes are told before the long tables
  for (const std::string& problem : {repetition(reference, "reference"), repetition(with, "compared")})
    if (!problem.empty()) return usage(problem);
  const bool demanded = !options.tolerance.empty() || !options.csv.empty() || !options.moment.empty();
  AnalysedRuns first = analysed_runs(reference, demanded), second = analysed_runs(with, demanded);
  for (const std::string& problem : {mixture(first.runs, "reference"), mixture(second.runs, "compared")})
    if (!problem.empty()) return usage(problem);
  std::cout << "reference: " << runs_text(reference) << "\ncompared:  " << runs_text(with) << '\n';
  std::cout << same_seed_warnings(reference) << same_seed_warnings(with);
  print_bed_comparison(reference, with);
  std::cout << '\n' << first.says << second.says;
  RunSets sets{std::move(first.runs), std::move(second.runs), 0};
  if (!sets.reference.empty() && !sets.compared.empty()) return compare_analyses(sets, options);
  std::cout << "Distributions, profiles, maps and intervals are compared once runs of both sets are analysed.\n";
  return exit_code::ok;
}

}  // namespace wedge
