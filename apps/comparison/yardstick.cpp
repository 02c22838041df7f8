// yardstick.cpp: how far the full model is from its own wedges.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "apps/comparison/draws.hpp"
#include "apps/comparison/resampling.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t yardstick_stream = 3;

/// What may be drawn in place of a compared run: of each reference run its wedges or, where domains are alike,
/// itself.
std::vector<std::vector<Sample>> pieces_of(const Observable& o, const Design& design) {
  std::vector<std::vector<Sample>> pieces;
  for (std::size_t run = 0; run < o.reference.size(); ++run) {
    std::vector<Sample> of_run = design.alike ? std::vector<Sample>{o.reference[run]} : o.wedges[run];
    if (!of_run.empty()) pieces.push_back(std::move(of_run));
  }
  return pieces;
}

const Sample& any_of(const std::vector<std::vector<Sample>>& pieces, Draws& draws) {
  const std::vector<Sample>& of_run = pieces[draws.below(pieces.size())];
  return of_run[draws.below(of_run.size())];
}

}  // namespace

YardstickPlan plan_yardstick(const Design& design, const std::vector<std::size_t>& wedges) {
  YardstickPlan plan;
  plan.runs = wedges.size();
  plan.pieces = design.alike ? wedges.size() : std::accumulate(wedges.begin(), wedges.end(), std::size_t{0});
  plan.one_run = plan.runs == 1;
  if (plan.pieces == 0)
    plan.why_not = "the reference runs have no wedges of this angle";
  else if (design.alike && plan.pieces == 1)
    plan.why_not = "one reference run has no spread";
  else if (!design.alike && plan.pieces < fewest_wedges)
    plan.why_not = std::to_string(plan.pieces) +
                   (plan.pieces == 1 ? " wedge of this angle is" : " wedges of this angle are") +
                   " too few, at least " + std::to_string(fewest_wedges) + " of all reference runs are needed";
  if (!plan.why_not.empty()) return plan;
  const auto n = static_cast<double>(plan.pieces);
  plan.growth = std::sqrt(n / (n - 1));
  plan.widening = student_95(n - 1) / student_95(std::numeric_limits<double>::infinity());
  return plan;
}

Yardstick yardstick(const Observable& o, Measure measure, const Design& design) {
  const std::vector<std::vector<Sample>> pieces = pieces_of(o, design);
  std::vector<std::size_t> counts;
  for (std::size_t run = 0; run < o.reference.size(); ++run) counts.push_back(o.wedges[run].size());
  const YardstickPlan plan = plan_yardstick(design, counts);
  if (!plan.why_not.empty()) return {not_known, not_known, not_known, plan.pieces};
  Draws draws(yardstick_stream);
  std::vector<double> values;
  for (int k = 0; k < repetitions; ++k) {
    Pooling drawn, vessels;
    for (std::size_t n = 0; n < o.compared.size(); ++n) drawn.add(any_of(pieces, draws));
    // The only run cannot vary: as many of its wedges as make up a vessel stand for it.
    for (std::size_t n = 0; plan.one_run && n < static_cast<std::size_t>(design.wedges_per_reference); ++n)
      vessels.add(any_of(pieces, draws));
    for (std::size_t n = 0; !plan.one_run && n < plan.runs; ++n)
      vessels.add(o.reference[draws.below(o.reference.size())]);
    const double value = distance(measure, o.bins, vessels.pool(), drawn.pool());
    if (std::isfinite(value)) values.push_back(value);
  }
  if (values.empty()) return {not_known, not_known, not_known, plan.pieces};
  std::sort(values.begin(), values.end());
  const double median = quantile(values, 0.5), low = quantile(values, 0.025), high = quantile(values, 0.975);
  const bool signed_measure = measure == Measure::difference;
  // All of a distance is noise and grows; a difference has a middle, which is not 0 where wedges are measured
  // otherwise.
  const double centre = signed_measure ? median : plan.growth * median, wider = plan.growth * plan.widening;
  return {centre, signed_measure ? centre + wider * (low - median) : plan.growth * low,
          centre + wider * (high - median), plan.pieces};
}

}  // namespace wedge
