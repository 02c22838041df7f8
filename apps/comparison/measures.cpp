// measures.cpp: pools, and the distances between them.
#include "apps/comparison/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/require.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Integral of abs of a straight line from a to b over the length 1.
double mean_magnitude(double a, double b) {
  const double sum = std::abs(a) + std::abs(b);
  if (a * b >= 0) return sum / 2;
  return (a * a + b * b) / (2 * sum);  // two triangles: the line changes sign at a / (a - b)
}

bool empty(const Pool& pool) { return pool.value.size() == 0 || !(pool.weight.maxCoeff() > 0); }

}  // namespace

void Pooling::add(const Sample& sample, double times) {
  if (content_.size() == 0) {
    content_ = Eigen::ArrayXd::Zero(sample.content.size());
    amount_ = content_;
  }
  require(sample.content.size() == content_.size(), "samples of different sizes pooled");
  content_ += times * sample.content;
  amount_ += times * sample.amount;
  samples_ += times;
}

Pool Pooling::pool() const {
  if (content_.size() == 0) return {};
  return {(amount_ > 0).select(content_ / amount_, 0.0), amount_ / samples_};
}

Pool pool_of(const std::vector<Sample>& samples) {
  Pooling pooling;
  for (const Sample& sample : samples) pooling.add(sample);
  return pooling.pool();
}

double wasserstein(const Bins& bins, const Pool& first, const Pool& second) {
  const Eigen::ArrayXd gap = first.value - second.value;
  double sum = 0;
  for (Eigen::Index k = 0; k + 1 < gap.size(); ++k) {
    // Between the whole numbers on both sides of edge k the distributions are level.
    const double height = bins.whole_numbers ? std::abs(gap[k]) : mean_magnitude(gap[k], gap[k + 1]);
    sum += height * (bins.edges[k + 1] - bins.edges[k]);
  }
  return sum;
}

double kolmogorov_smirnov(const Pool& first, const Pool& second) {
  return (first.value - second.value).abs().maxCoeff();
}

double rms_difference(const Pool& first, const Pool& second) {
  double squares = 0, weights = 0;
  for (Eigen::Index k = 0; k < first.value.size(); ++k) {
    if (!(first.weight[k] > 0) || !(second.weight[k] > 0)) continue;
    const double weight = (first.weight[k] + second.weight[k]) / 2, gap = second.value[k] - first.value[k];
    squares += weight * gap * gap;
    weights += weight;
  }
  return weights > 0 ? std::sqrt(squares / weights) : not_known;
}

double distance(Measure measure, const Bins& bins, const Pool& first, const Pool& second) {
  if (empty(first) || empty(second)) return not_known;
  switch (measure) {
    case Measure::difference:
      return second.value[0] - first.value[0];
    case Measure::wasserstein:
      return wasserstein(bins, first, second);
    case Measure::kolmogorov_smirnov:
      return kolmogorov_smirnov(first, second);
    case Measure::rms:
      return rms_difference(first, second);
  }
  return not_known;
}

Magnitude distribution_magnitude(const Bins& bins, const Pool& pool) {
  if (empty(pool)) return {not_known, not_known};
  double mean = 0, square = 0;
  for (Eigen::Index k = 0; k + 1 < pool.value.size(); ++k) {
    const double share = pool.value[k + 1] - pool.value[k], width = bins.edges[k + 1] - bins.edges[k];
    const double middle = (bins.edges[k + 1] + bins.edges[k]) / 2;
    mean += share * middle;
    square += share * (middle * middle + (bins.whole_numbers ? 0 : width * width / 12));
  }
  return {mean, std::sqrt(std::max(0.0, square - mean * mean))};
}

Magnitude field_magnitude(const Pool& pool) {
  const double weights = pool.weight.sum();
  if (!(weights > 0)) return {not_known, not_known};
  return {(pool.weight * pool.value).sum() / weights,
          std::sqrt((pool.weight * pool.value.square()).sum() / weights)};
}

}  // namespace wedge
