// numbers_shown.hpp: numbers for people: as many digits as are worth reading.
#pragma once

#include <cmath>
#include <string>

#include "io/scene/diagnostics.hpp"

namespace wedge {

/// "-" when the number is not known.
inline std::string shown(double value, int digits) {
  if (!std::isfinite(value)) return "-";
  if (value == 0) return "0";
  const double unit = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
  return short_number(std::isfinite(unit) && unit > 0 ? std::round(value * unit) / unit : value);
}

}  // namespace wedge
