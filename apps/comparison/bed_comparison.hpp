// bed_comparison.hpp: what the beds of two sets of runs have in common, stage by stage, as their runs measured
// them.
#pragma once

#include <string>
#include <vector>

namespace wedge {

/// Prints a table for each stage that some run has finished. Throws FileError when a folder holds no run.
void print_bed_comparison(const std::vector<std::string>& reference, const std::vector<std::string>& compared);

}  // namespace wedge
