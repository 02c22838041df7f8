// comparison.hpp: two sets of analysed runs compared: one row for each quantity, region and measure.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observables.hpp"
#include "apps/comparison/resampling.hpp"

namespace wedge {

struct ComparisonRow {
  Kind kind = Kind::scalar;
  std::string moment, region, quantity, unit;
  Measure measure = Measure::difference;
  double reference = 0, compared = 0;  // means
  double value = 0;                    // difference (compared less reference) or distance
  Confidence interval;
  double relative = 0;  // value in parts of the reference's natural scale
  Yardstick yardstick;
  bool beyond = false;  // further than the full model is from its own wedges
  std::size_t reference_runs = 0, compared_runs = 0;
};

const char* name_of(Kind kind);
const char* name_of(Measure measure);
const char* name_of(Basis basis);

/// The rows of one quantity: one, or two of a distribution.
std::vector<ComparisonRow> compare(const Observable& observable, const Design& design);
/// All rows of a moment.
std::vector<ComparisonRow> compare(const RunSets& sets, const std::string& moment);

/// As a table of comma-separated values, with a header.
std::string comparison_csv(const std::vector<ComparisonRow>& rows);

}  // namespace wedge
