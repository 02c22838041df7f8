// bed_comparison.cpp: results/beds.csv of two sets of runs, a table for each stage.
#include "apps/comparison/bed_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <optional>

#include "apps/comparison/numbers_shown.hpp"
#include "apps/results/bed_table.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/results/text_table.hpp"
#include "io/scene/diagnostics.hpp"

namespace wedge {
namespace {

using Tables = std::vector<std::vector<StageResult>>;  // one per run

Tables read_tables(const std::vector<std::string>& folders) {
  Tables tables;
  for (const std::string& folder : folders) {
    const RunFolder run(folder);
    run.require_run();
    const bool measured = std::filesystem::exists(run.beds());  // not before the first stage has ended
    tables.push_back(measured ? read_bed_table(run.beds()) : std::vector<StageResult>());
  }
  return tables;
}

const StageResult* find_stage(const std::vector<StageResult>& table, const std::string& stage) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const StageResult& s) { return s.stage == stage; });
  return found == table.end() ? nullptr : &*found;
}

/// What the runs say about one quantity of a stage, where they say a number.
std::vector<double> values(const Tables& tables, const std::string& stage, const BedQuantity& quantity) {
  std::vector<double> found;
  for (const auto& table : tables) {
    const StageResult* row = find_stage(table, stage);
    if (!row) continue;
    for (const BedQuantity& q : row->quantities)
      if (q.name == quantity.name && q.unit == quantity.unit && std::isfinite(q.value)) found.push_back(q.value);
  }
  return found;
}

double mean(const std::vector<double>& numbers) {
  double sum = 0;
  for (const double x : numbers) sum += x;
  return numbers.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(numbers.size());
}

/// Standard deviation (with n - 1) of three and more, half of the range of two, not known for one.
double spread(const std::vector<double>& numbers) {
  if (numbers.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  if (numbers.size() == 2) return (*high - *low) / 2;
  const double centre = mean(numbers);
  double squares = 0;
  for (const double x : numbers) squares += (x - centre) * (x - centre);
  return std::sqrt(squares / static_cast<double>(numbers.size() - 1));
}

std::string percent(double reference, double other) {
  if (!std::isfinite(reference) || !std::isfinite(other)) return "-";
  if (reference == other) return "0.00";
  if (reference == 0) return "-";
  const double change = 100 * (other - reference) / std::abs(reference);
  char text[32];
  if (std::abs(change) < 1e4) {
    const auto hundredths = std::llround(100 * std::abs(change));
    std::snprintf(text, sizeof text, "%c%lld.%02lld", change < 0 ? '-' : '+', hundredths / 100, hundredths % 100);
  } else {
    std::snprintf(text, sizeof text, "%c%lld", change < 0 ? '-' : '+', std::llround(std::abs(change)));
  }
  return text;
}

void print_stage(const StageResult& stage, const Tables& reference, const Tables& with) {
  TextTable table;
  table.row({"", "reference", "spread", "compared", "difference [%]"});
  for (const BedQuantity& quantity : stage.quantities) {
    const std::vector<double> first = values(reference, stage.stage, quantity);
    const std::vector<double> second = values(with, stage.stage, quantity);
    table.row({quantity.name + (quantity.unit.empty() ? "" : " [" + quantity.unit + "]"), shown(mean(first), 5),
               shown(spread(first), 5), shown(mean(second), 5), percent(mean(first), mean(second))});
  }
  std::cout << "\nstage " << stage.stage << '\n' << table.text("  ");
}

/// Every stage that some run finished, in the order of the runs, and how many of each set finished it. Returns
/// whether there was any.
bool print_stages(const Tables& reference, const Tables& with) {
  std::vector<StageResult> stages;
  for (const Tables* tables : {&reference, &with})
    for (const auto& table : *tables)
      for (const StageResult& stage : table)
        if (!find_stage(stages, stage.stage)) stages.push_back(stage);
  for (const StageResult& stage : stages) {
    const auto finished = [&](const Tables& tables) {
      return std::count_if(tables.begin(), tables.end(),
                           [&](const auto& table) { return find_stage(table, stage.stage) != nullptr; });
    };
    print_stage(stage, reference, with);
    const auto first = finished(reference), second = finished(with);
    if (first != static_cast<std::ptrdiff_t>(reference.size()) ||
        second != static_cast<std::ptrdiff_t>(with.size()))
      std::cout << "  finished by " << first << " of " << reference.size() << " reference and " << second << " of "
                << with.size() << " compared runs\n";
  }
  return !stages.empty();
}

}  // namespace

void print_bed_comparison(const std::vector<std::string>& reference, const std::vector<std::string>& compared) {
  const Tables first = read_tables(reference), second = read_tables(compared);
  if (!print_stages(first, second)) {
    std::cout << "\nno run has a finished stage in results/beds.csv\n";
    return;
  }
  std::cout << "\nNumbers are those of the whole vessel, means over the runs, at the end of each stage. Spread: "
            << (reference.size() == 1
                    ? "not known from one run; several seeds give it: wedge run SCENE.toml -o FOLDER "
                      "--set particles.seed=2, and name all folders"
                : reference.size() == 2 ? "half of the range of the two reference runs"
                                        : "standard deviation of the reference runs")
            << ".\n";
}

}  // namespace wedge
