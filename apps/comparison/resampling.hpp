// resampling.hpp: confidence intervals by bootstrap, and the yardstick: how far the full model is from its own
// wedges.
#pragma once

#include <string>
#include <vector>

#include "apps/comparison/observable.hpp"

namespace wedge {

/// As many repetitions as every bootstrap and every yardstick takes.
inline constexpr int repetitions = 1000;
/// From so many runs in both sets on the runs themselves are resampled.
inline constexpr std::size_t enough_seeds = 5;

/// Value below which the share p of the numbers lies, straight between neighbours. Pre: sorted, not empty.
double quantile(const std::vector<double>& sorted, double p);
/// The t beyond which (on both sides together) a Student variable of `freedom` degrees lies with 5 %.
double student_95(double freedom);
/// Share to cut at each end of a bootstrap of n samples so that the rest covers 95 %: less than 2.5 %, since
/// resampling n things knows neither n / (n - 1) of the variance nor that it is itself estimated (Hesterberg 2015,
/// "expanded percentile").
double tail_share(double n, double freedom);

enum class Basis { seeds, wedges, intervals, none };

struct Confidence {
  double low = 0, high = 0;  // 95 %; nan: not known
  Basis basis = Basis::none;
};
/// Interval of the difference, or of the distance that the laws behind the runs have without noise: over the runs
/// where both sets have enough_seeds, else over the wedges of the reference runs, else (scalars) from spread and
/// own intervals of the runs. README.md says how.
Confidence confidence(const Observable& observable, Measure measure, const Design& design);

/// Fewer wedges, of all reference runs together, are no yardstick: two may agree by chance.
inline constexpr std::size_t fewest_wedges = 4;

/// What the yardstick of a set can rest on.
struct YardstickPlan {
  std::string why_not;     // no yardstick; else empty
  std::size_t pieces = 0;  // wedges of all reference runs or, where domains are alike, the runs
  std::size_t runs = 0;    // reference runs
  bool one_run = false;    // wedges are compared with wedges of the same run, which know nothing of other seeds
  // Of n things drawn with replacement the mean scatters less than it should, and so few know the spread of all
  // badly (as in tail_share).
  double growth = 1;    // of all drawn noise, sqrt(n / (n - 1))
  double widening = 1;  // of the 95 % about the median, t(n - 1) / 1.96
};
/// `wedges`: how many each reference run has.
YardstickPlan plan_yardstick(const Design& design, const std::vector<std::size_t>& wedges);

struct Yardstick {
  double median = 0, low = 0, high = 0;  // 95 % of what sets of equal laws give lies between; nan: not known
  std::size_t pieces = 0;                // that were drawn from, as in YardstickPlan
};
/// Distances of as many wedges as there are compared runs to as many vessels as there are reference runs, both
/// drawn from the reference runs, independently and with replacement.
Yardstick yardstick(const Observable& observable, Measure measure, const Design& design);

}  // namespace wedge
