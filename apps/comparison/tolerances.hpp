// tolerances.hpp: which rows of a comparison are outside of what a tolerance file allows.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/comparison.hpp"
#include "io/scene/tolerance_file.hpp"

namespace wedge {

struct Breach {
  const ComparisonRow* row = nullptr;
  std::string says;  // "relative 0.07 is above 0.05"
};

struct Judgement {
  std::size_t judged = 0;  // rows that some tolerance is about
  std::vector<Breach> breaches;
};

/// Throws SceneError, with every place, when a tolerance is about no row: most likely a name is misspelt, and a
/// bound that is never tested must not look like one that holds.
Judgement judge(const std::vector<ComparisonRow>& rows, const ToleranceFile& file);

}  // namespace wedge
