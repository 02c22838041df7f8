// comparison_table.hpp: rows of a comparison as tables for people.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/comparison.hpp"
#include "apps/comparison/tolerances.hpp"

namespace wedge {

/// What sets are compared, in which regions, with which yardstick.
std::string sets_text(const RunSets& sets);
/// Tables of scalars, distributions, profiles and maps of one moment; `at_rest`: as velocities_at_rest().
std::string moment_text(const std::string& moment, const std::vector<ComparisonRow>& rows, bool at_rest);
/// How to read the tables, and how many rows are beyond.
std::string legend_text(const std::vector<ComparisonRow>& rows);
std::string judgement_text(const Judgement& judgement, const std::string& tolerance_file);

}  // namespace wedge
