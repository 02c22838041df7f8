// observable.hpp: one quantity of two sets of runs, ready to be pooled and compared.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/measures.hpp"

namespace wedge {

enum class Kind { scalar, distribution, profile, map };

struct Observable {
  Kind kind = Kind::scalar;
  std::string moment, region, quantity, unit;
  Bins bins;                                // of a distribution
  std::vector<Sample> reference, compared;  // one of each run that tells it
  std::vector<std::vector<Sample>> wedges;  // of each reference run; may be empty
  // Of a scalar: what each run itself says of its standard error; nan where it says nothing.
  std::vector<double> reference_errors, compared_errors;
};

/// How the domains of the two sets are related.
struct Design {
  bool alike = false;            // domains of one kind and angle: reference runs are their own yardstick
  int wedges_per_reference = 1;  // that make up the domain of a reference run
  int wedges_per_compared = 1;   // ... of a compared run
};

}  // namespace wedge
