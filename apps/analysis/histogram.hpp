// histogram.hpp: counts in bins that are even near zero and of even ratio far from it, or one for each whole
// number.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>

namespace wedge {

/// Edges of bins: edge(m) = scale sinh(m step); of whole numbers (step 0) m - 1/2.
struct Bins {
  double scale = 1, step = 0;

  double edge(int m) const { return step > 0 ? scale * std::sinh(m * step) : m - 0.5; }
  /// The bin m that holds a value: edge(m) <= value < edge(m + 1), up to round-off.
  int bin(double value) const {
    return static_cast<int>(std::floor(step > 0 ? std::asinh(value / scale) / step : value + 0.5));
  }
};

/// Counts by bin.
class Histogram {
public:
  void add(int bin) { counts_[bin] += 1; }
  const std::map<int, double>& counts() const { return counts_; }
  double total() const {
    double sum = 0;
    for (const auto& entry : counts_) sum += entry.second;
    return sum;
  }

private:
  std::map<int, double> counts_;
};

}  // namespace wedge
