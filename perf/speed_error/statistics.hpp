// statistics.hpp: means over seeds, and differences of means with their uncertainty.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace wedge::speed_error {

struct Sample {
  std::vector<double> values;

  std::size_t count() const { return values.size(); }
  double mean() const {
    double sum = 0;
    for (const double x : values) sum += x;
    return sum / static_cast<double>(count());
  }
  double variance() const {
    double sum = 0;
    for (const double x : values) sum += (x - mean()) * (x - mean());
    return sum / (static_cast<double>(count()) - 1);
  }
  /// Variance of the mean.
  double mean_variance() const { return variance() / static_cast<double>(count()); }
  /// Not a number with less than two values.
  double standard_error() const { return std::sqrt(mean_variance()); }
};

/// 99.5 % quantile of Student's t with `freedom` degrees of freedom: Cornish-Fisher expansion about the normal one,
/// Abramowitz & Stegun, Handbook of Mathematical Functions, 26.7.5; 3 % low at 3 degrees, better above.
inline double student_quantile(double freedom) {
  const double z = 2.5758293, z2 = z * z, f = freedom;
  return z + z * (z2 + 1) / (4 * f) + z * (5 * z2 * z2 + 16 * z2 + 3) / (96 * f * f) +
         z * (3 * z2 * z2 * z2 + 19 * z2 * z2 + 17 * z2 - 15) / (384 * f * f * f);
}

/// Of two means, as a part of the reference.
struct Difference {
  double value = 0;
  double uncertainty = std::numeric_limits<double>::quiet_NaN();  // standard error
  double bound = std::numeric_limits<double>::quiet_NaN();        // half width of the interval of 99 % confidence
  bool significant() const { return std::fabs(value) > bound; }
};

/// Welch's comparison: the two samples may spread differently.
inline Difference difference(const Sample& sample, const Sample& reference) {
  const double scale = std::fabs(reference.mean());
  const double a = sample.mean_variance(), b = reference.mean_variance();
  Difference d;
  d.value = (sample.mean() - reference.mean()) / scale;
  d.uncertainty = std::sqrt(a + b) / scale;
  const double na = static_cast<double>(sample.count()) - 1, nb = static_cast<double>(reference.count()) - 1;
  const double freedom = (a + b) * (a + b) / (a * a / na + b * b / nb);
  d.bound = student_quantile(freedom) * d.uncertainty;
  return d;
}

}  // namespace wedge::speed_error
