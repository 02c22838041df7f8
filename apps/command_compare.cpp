// command_compare.cpp: wedge compare: two sets of runs, their beds stage by stage and their analyses.
#include <algorithm>
#include <iostream>

#include "apps/commands.hpp"
#include "apps/comparison/bed_comparison.hpp"
#include "apps/comparison/comparison_table.hpp"
#include "apps/run_folder.hpp"
#include "core/require.hpp"
#include "io/atomic_file.hpp"

namespace wedge {
namespace {

std::string runs_text(const std::vector<std::string>& folders) {
  std::string text;
  for (const std::string& folder : folders) text += (text.empty() ? "" : ", ") + folder;
  return text + (folders.size() == 1 ? "  (1 run)" : "  (" + std::to_string(folders.size()) + " runs)");
}

/// The runs that are analysed; says what of the others is missing.
std::vector<RunResults> analysed_runs(const std::vector<std::string>& folders, bool demanded) {
  std::vector<RunResults> runs;
  for (const std::string& folder : folders) {
    RunResults run = read_domain(folder);
    if (analysed(run)) {
      for (const std::string& file : run.missing)
        std::cout << folder << ": there is no results/" << file << ": what it tells of this run is left out\n";
      runs.push_back(std::move(run));
      continue;
    }
    const std::string says = folder + ": is not analysed: wedge analyse " + folder;
    if (demanded) throw FileError(says);
    std::cout << says << '\n';
  }
  return runs;
}

int usage(const std::string& problem) {
  std::cerr << "wedge: " << problem << '\n';
  return exit_code::usage;
}

/// What is wrong with a set whose runs have different domains; "" for a sound one.
std::string mixture(const std::vector<RunResults>& runs, const std::string& set) {
  for (const RunResults& run : runs)
    if (run.order != runs[0].order || run.slot != runs[0].slot)
      return "the " + set + " runs are of different domains: " + runs[0].folder + " (" +
             (runs[0].slot ? "slot" : angle_text(runs[0].order) + " degrees") + ") and " + run.folder + " (" +
             (run.slot ? "slot" : angle_text(run.order) + " degrees") + "); compare one angle at a time";
  return "";
}

/// 360 degrees / angle of the wedges that serve: those of the compared sector or, for two sets of full vessels,
/// which need them for intervals only, the widest there are.
int wedges_wanted(const RunSets& sets) {
  const RunResults &reference = sets.reference[0], &compared = sets.compared[0];
  if (reference.slot || compared.slot || reference.order > 1) return 0;
  return compared.order > 1 ? compared.order : widest_wedges(reference);
}

int compare_analyses(RunSets& sets, const CompareOptions& options) {
  for (const std::string& problem : {mixture(sets.reference, "reference"), mixture(sets.compared, "compared")})
    if (!problem.empty()) return usage(problem);
  sets.wedge_order = wedges_wanted(sets);
  for (auto* set : {&sets.reference, &sets.compared})
    for (RunResults& run : *set) read_results(run, sets.wedge_order);
  std::vector<std::string> moments = common_moments(sets);
  if (!options.moment.empty()) {
    if (std::find(moments.begin(), moments.end(), options.moment) == moments.end())
      return usage("--moment " + options.moment + ": both sets do not have it; " +
                   suggestion(options.moment, moments));
    moments = {options.moment};
  }
  std::cout << sets_text(sets);
  if (moments.empty()) std::cout << "the analyses have no moment in common\n";
  std::vector<ComparisonRow> rows;
  for (const std::string& moment : moments) {
    const std::vector<ComparisonRow> of_moment = compare(sets, moment);
    std::cout << moment_text(moment, of_moment) << std::flush;
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
  std::cout << "reference: " << runs_text(reference) << "\ncompared:  " << runs_text(with) << '\n';
  print_bed_comparison(reference, with);
  std::cout << '\n';
  const bool demanded = !options.tolerance.empty() || !options.csv.empty() || !options.moment.empty();
  RunSets sets{analysed_runs(reference, demanded), analysed_runs(with, demanded), 0};
  if (!sets.reference.empty() && !sets.compared.empty()) return compare_analyses(sets, options);
  std::cout << "Distributions, profiles, maps and intervals are compared once runs of both sets are analysed.\n";
  return exit_code::ok;
}

}  // namespace wedge
