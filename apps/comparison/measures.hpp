// measures.hpp: how far two pools of runs are apart: difference, Wasserstein, Kolmogorov-Smirnov, root mean square.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace wedge {

/// What one run (or wedge) says of one quantity, entry by entry, so that pools are sums: `amount` is how much it
/// has to say, `content` the sum over that amount. A scalar: one entry, 1 and the value. A field: the weight of
/// each cell, and weight times value. A distribution: all grains, and grains below each edge.
struct Sample {
  Eigen::ArrayXd content, amount;
};

/// What several samples say together: sum of contents over sum of amounts; `weight` is the mean amount, 0 where
/// none of them knows anything (and `value` then 0).
struct Pool {
  Eigen::ArrayXd value, weight;
};

/// Adds up samples, each any number of times.
class Pooling {
public:
  void add(const Sample& sample, double times = 1);
  Pool pool() const;

private:
  Eigen::ArrayXd content_, amount_;
  double samples_ = 0;
};

Pool pool_of(const std::vector<Sample>& samples);

enum class Measure { difference, wasserstein, kolmogorov_smirnov, rms };

/// Edges between the bins of a distribution; a pool's value is the cumulative distribution at each. Between edges
/// it is straight, of whole numbers (edges halfway between them) a step at each.
struct Bins {
  Eigen::ArrayXd edges;
  bool whole_numbers = false;
};

/// Integral of abs(F1 - F2) over the values, exact for straight pieces. Pre: both pools have bins.edges.size()
/// entries.
double wasserstein(const Bins& bins, const Pool& first, const Pool& second);
/// Largest abs(F1 - F2).
double kolmogorov_smirnov(const Pool& first, const Pool& second);
/// Root of the mean square of the difference over entries that both know, weighted by their mean weight; not known
/// (nan) where there are none.
double rms_difference(const Pool& first, const Pool& second);

/// By any of the measures; `difference` is second less first, with its sign. Not known (nan) where a pool is empty.
double distance(Measure measure, const Bins& bins, const Pool& first, const Pool& second);

/// The mean of a pool, and the natural scale that its distances are told in parts of.
struct Magnitude {
  double mean = 0, scale = 0;
};
/// Scale: standard deviation, of the same shape as wasserstein() takes the distribution to have.
Magnitude distribution_magnitude(const Bins& bins, const Pool& pool);
/// Weighted mean of a field; scale: root of its weighted mean square.
Magnitude field_magnitude(const Pool& pool);

}  // namespace wedge
