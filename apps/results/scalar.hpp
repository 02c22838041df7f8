// scalar.hpp: a number of a bed with its interval, under its name of the vocabulary.
#pragma once

#include <limits>
#include <string_view>

#include "apps/results/vocabulary.hpp"

namespace wedge {

/// A number with its 95 % interval; nan where not known.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double low = std::numeric_limits<double>::quiet_NaN(), high = std::numeric_limits<double>::quiet_NaN();

  /// Without an interval.
  static Estimate of(double value) {
    Estimate e;
    e.value = value;
    return e;
  }
};

struct Scalar {
  const ResultQuantity* quantity;
  Estimate estimate;
};

/// Pre: the vocabulary has the name.
inline Scalar scalar(std::string_view name, Estimate estimate) { return {&quantity(name), estimate}; }
inline Scalar scalar(std::string_view name, double value) { return scalar(name, Estimate::of(value)); }

}  // namespace wedge
