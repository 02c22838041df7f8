// bootstrap.cpp: confidence intervals of distances, over seeds or over wedges.
#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/comparison/draws.hpp"
#include "apps/comparison/resampling.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double normal_95 = 1.959963984540054;  // 95 % of a normal variable lie within so many standard deviations
constexpr std::uint32_t seeds_stream = 1, wedges_stream = 2;

double real(std::size_t n) { return static_cast<double>(n); }

/// Integral of cos(u)^power from 0 to `end`, by Simpson's rule.
double cosine_integral(double power, double end) {
  constexpr int pieces = 400;
  double sum = 0;
  for (int k = 0; k <= pieces; ++k) {
    const double weight = k == 0 || k == pieces ? 1 : k % 2 == 1 ? 4 : 2;
    sum += weight * std::pow(std::max(0.0, std::cos(end * k / pieces)), power);
  }
  return sum * end / (3 * pieces);
}

Pool resampled(const std::vector<Sample>& runs, Draws& draws) {
  Pooling pooling;
  for (std::size_t k = 0; k < runs.size(); ++k) pooling.add(runs[draws.below(runs.size())]);
  return pooling.pool();
}

/// From resampled distances to distances without noise. The square of a distance grows by that of the noise: that
/// of `value` did once, that of a resampled one, whose noise comes on top, twice. `n` as in tail_share.
void take_noise_off(std::vector<double>& resampled, double value, double n) {
  double squares = 0;
  for (const double x : resampled) squares += x * x / real(resampled.size());
  const double noise = std::max(0.0, squares - value * value);
  for (double& x : resampled) x = std::sqrt(std::max(0.0, x * x - noise - noise * n / (n - 1)));
}

/// The interval that values resampled from n things leave.
Confidence interval_of(std::vector<double> values, const Observable& o, Measure measure, double n, Basis basis) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double x) { return !std::isfinite(x); }),
               values.end());
  if (values.empty()) return {not_known, not_known, Basis::none};
  if (measure != Measure::difference)
    take_noise_off(values, distance(measure, o.bins, pool_of(o.reference), pool_of(o.compared)), n);
  std::sort(values.begin(), values.end());
  const double tail = tail_share(n, n - 1);
  return {quantile(values, tail), quantile(values, 1 - tail), basis};
}

Confidence over_seeds(const Observable& o, Measure measure) {
  Draws draws(seeds_stream);
  std::vector<double> values;
  for (int k = 0; k < repetitions; ++k) {
    const Pool reference = resampled(o.reference, draws), compared = resampled(o.compared, draws);
    values.push_back(distance(measure, o.bins, reference, compared));
  }
  // The smaller set decides: sectors, of few grains, bring most of the noise, and may be the fewer.
  const double fewer = real(std::min(o.reference.size(), o.compared.size()));
  return interval_of(values, o, measure, fewer, Basis::seeds);
}

/// `pool` moved by how far one draw of wedges is from another; unknown where any of them is.
Pool moved(Pool pool, const Pool& to, const Pool& from) {
  pool.weight = (to.weight > 0 && from.weight > 0).select(pool.weight, 0.0);
  pool.value += to.value - from.value;
  return pool;
}

/// Runs that have wedges.
std::vector<const std::vector<Sample>*> donors_of(const Observable& o) {
  std::vector<const std::vector<Sample>*> donors;
  for (const auto& wedges : o.wedges)
    if (!wedges.empty()) donors.push_back(&wedges);
  return donors;
}

/// `runs` runs drawn, of each `pieces` wedges.
Pool drawn_wedges(const std::vector<const std::vector<Sample>*>& donors, std::size_t runs, int pieces,
                  Draws& draws) {
  Pooling pooling;
  for (std::size_t k = 0; k < runs; ++k) {
    const std::vector<Sample>& wedges = *donors[draws.below(donors.size())];
    for (int piece = 0; piece < pieces; ++piece) pooling.add(wedges[draws.below(wedges.size())]);
  }
  return pooling.pool();
}

/// Variance of a scalar over all wedges, each `pieces` of which make one run.
double wedge_variance(const std::vector<const std::vector<Sample>*>& donors, int pieces) {
  double count = 0, sum = 0, squares = 0;
  for (const auto* wedges : donors) {
    for (const Sample& wedge : *wedges) {
      count += 1;
      sum += wedge.content[0];
      squares += wedge.content[0] * wedge.content[0];
    }
  }
  return std::max(0.0, squares - sum * sum / count) / (count - 1) / pieces;
}

/// Variance of the mean of a set of scalars, and its degrees of freedom (0: not known).
struct MeanError {
  double variance = 0, freedom = 0;
};

/// From the spread of the runs or from their own errors, whichever says more: a few runs may agree by chance, and
/// an own error knows nothing of other seeds.
MeanError mean_error(const std::vector<Sample>& runs, const std::vector<double>& own) {
  const double n = real(runs.size());
  double mean = 0, squares = 0, own_squares = 0;
  for (const Sample& run : runs) mean += run.content[0] / n;
  for (const Sample& run : runs) squares += (run.content[0] - mean) * (run.content[0] - mean);
  for (const double error : own) own_squares += error * error;
  MeanError result;
  if (runs.size() > 1) result = {squares / (n - 1) / n, n - 1};
  if (!own.empty() && std::isfinite(own_squares) &&
      (result.freedom == 0 || own_squares / (n * n) > result.variance))
    result = {own_squares / (n * n), 1e6};  // as good as known
  return result;
}

Confidence over_wedges(const Observable& o, Measure measure, const Design& design) {
  const auto donors = donors_of(o);
  Draws draws(wedges_stream);
  const Pool reference = pool_of(o.reference), compared = pool_of(o.compared);
  std::vector<double> values;
  for (int k = 0; k < repetitions; ++k) {
    const Pool sectors = drawn_wedges(donors, o.compared.size(), design.wedges_per_compared, draws);
    const Pool vessels = drawn_wedges(donors, o.reference.size(), design.wedges_per_reference, draws);
    values.push_back(distance(measure, o.bins, reference, moved(compared, sectors, vessels)));
  }
  double count = 0;
  for (const auto* wedges : donors) count += real(wedges->size());
  Confidence result = interval_of(values, o, measure, count, Basis::wedges);
  if (measure != Measure::difference) return result;
  // Sectors that scatter more than wedges do say so themselves.
  const double known = wedge_variance(donors, design.wedges_per_compared) / real(o.compared.size());
  const double more = std::max(0.0, mean_error(o.compared, o.compared_errors).variance - known);
  const double value = distance(measure, o.bins, reference, compared);
  result.low = value - std::hypot(value - result.low, normal_95 * std::sqrt(more));
  result.high = value + std::hypot(result.high - value, normal_95 * std::sqrt(more));
  return result;
}

/// Welch's interval of the difference of two means.
Confidence from_runs(const Observable& o) {
  const MeanError first = mean_error(o.reference, o.reference_errors),
                  second = mean_error(o.compared, o.compared_errors);
  if (first.freedom == 0 || second.freedom == 0) return {not_known, not_known, Basis::none};
  const double variance = first.variance + second.variance;
  const double freedom = variance > 0 ? variance * variance /
                                            (first.variance * first.variance / first.freedom +
                                             second.variance * second.variance / second.freedom)
                                      : 1;
  const double half = student_95(freedom) * std::sqrt(variance);
  const double value = distance(Measure::difference, o.bins, pool_of(o.reference), pool_of(o.compared));
  return {value - half, value + half, Basis::intervals};
}

}  // namespace

double quantile(const std::vector<double>& sorted, double p) {
  const double place = std::clamp(p, 0.0, 1.0) * real(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (place - real(below)) * (sorted[below + 1] - sorted[below]);
}

double student_95(double freedom) {
  if (freedom > 1e4) return normal_95;
  // t = sqrt(freedom) tan(u) makes the density cos(u)^(freedom - 1).
  const double right_angle = std::acos(0.0), whole = cosine_integral(freedom - 1, right_angle);
  double low = 0, high = right_angle;
  for (int k = 0; k < 50; ++k) {
    const double middle = (low + high) / 2;
    (cosine_integral(freedom - 1, middle) < 0.95 * whole ? low : high) = middle;
  }
  return std::sqrt(freedom) * std::tan((low + high) / 2);
}

double tail_share(double n, double freedom) {
  return 0.5 * std::erfc(std::sqrt(n / (n - 1)) * student_95(freedom) / std::sqrt(2.0));
}

Confidence confidence(const Observable& o, Measure measure, const Design& design) {
  if (o.reference.empty() || o.compared.empty()) return {not_known, not_known, Basis::none};
  if (std::min(o.reference.size(), o.compared.size()) >= enough_seeds) return over_seeds(o, measure);
  std::size_t wedges = 0;
  for (const auto* of_run : donors_of(o)) wedges += of_run->size();
  if (wedges >= 3) return over_wedges(o, measure, design);
  if (measure == Measure::difference) return from_runs(o);
  return {not_known, not_known, Basis::none};
}

}  // namespace wedge
