// test_compare.cpp: distances between pools with known answers; do intervals and yardstick keep what they promise?
#include <cmath>
#include <functional>
#include <vector>

#include "apps/comparison/comparison.hpp"
#include "core/random.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

namespace {

const double pi = std::acos(-1.0);

double normal_share(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

/// A pool of a distribution with this cumulative function at n + 1 even edges between low and high.
Pool law(const Bins& bins, const std::function<double(double)>& cumulative) {
  Pool pool{bins.edges.unaryExpr(cumulative), Eigen::ArrayXd::Ones(bins.edges.size())};
  return pool;
}
Bins even_bins(double low, double high, int n) { return {Eigen::ArrayXd::LinSpaced(n + 1, low, high), false}; }

/// Whole numbers 0, 1, ... with these grains.
Pool whole_numbers(const std::vector<double>& counts) {
  Sample sample{Eigen::ArrayXd::Zero(static_cast<Eigen::Index>(counts.size()) + 1), {}};
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(k);
    sample.content[at + 1] = sample.content[at] + counts[k];
  }
  sample.amount = Eigen::ArrayXd::Constant(sample.content.size(), sample.content[sample.content.size() - 1]);
  return pool_of({sample});
}
Bins whole_bins(int n) { return {Eigen::ArrayXd::LinSpaced(n + 1, -0.5, n - 0.5), true}; }

Sample field(const std::vector<double>& weights, const std::vector<double>& values) {
  const auto n = static_cast<Eigen::Index>(weights.size());
  const Eigen::ArrayXd w = Eigen::Map<const Eigen::ArrayXd>(weights.data(), n);
  return {w * Eigen::Map<const Eigen::ArrayXd>(values.data(), n), w};
}

Sample scalar(double value) { return {Eigen::ArrayXd::Constant(1, value), Eigen::ArrayXd::Ones(1)}; }

/// Numbers of a normal law of mean 0 and deviation 1.
class Normal {
public:
  explicit Normal(std::uint32_t stream) : random_(77, stream) {}
  double operator()() {
    const double radius = std::sqrt(-2 * std::log(1 - random_.uniform()));
    return radius * std::cos(2 * pi * random_.uniform());
  }

private:
  RandomStream random_;
};

/// A vessel and its quarters: a scalar that varies by `seeds` from run to run and by 1 from quarter to quarter.
struct Vessel4 {
  Sample whole;
  std::vector<Sample> wedges;
};
Vessel4 vessel(Normal& normal, double seeds) {
  Vessel4 run;
  const double common = seeds * normal();
  for (int k = 0; k < 4; ++k) run.wedges.push_back(scalar(10 + common + normal()));
  run.whole = scalar(pool_of(run.wedges).value[0]);
  return run;
}
Observable trial(Normal& normal, int references, int sectors, double seeds, double shift) {
  Observable o;
  for (int k = 0; k < references; ++k) {
    Vessel4 run = vessel(normal, seeds);
    o.reference.push_back(run.whole);
    o.wedges.push_back(run.wedges);
    o.reference_errors.push_back(std::nan(""));
  }
  for (int k = 0; k < sectors; ++k) {
    o.compared.push_back(scalar(10 + shift + seeds * normal() + normal()));
    o.compared_errors.push_back(std::nan(""));
  }
  return o;
}
constexpr Design quarter{false, 4, 1};

double share_beyond(int references, int sectors, double seeds, double shift, int trials, std::uint32_t stream) {
  Normal normal(stream);
  int beyond = 0;
  for (int k = 0; k < trials; ++k)
    beyond += compare(trial(normal, references, sectors, seeds, shift), quarter)[0].beyond ? 1 : 0;
  return static_cast<double>(beyond) / trials;
}

/// A histogram of `grains` normal numbers around `mean`.
Sample histogram(Normal& normal, const Bins& bins, int grains, double mean) {
  const Eigen::Index n = bins.edges.size();
  Sample sample{Eigen::ArrayXd::Zero(n), Eigen::ArrayXd::Constant(n, grains)};
  for (int k = 0; k < grains; ++k) {
    const double value = mean + normal();
    for (Eigen::Index e = 0; e < n; ++e) sample.content[e] += value < bins.edges[e] ? 1 : 0;
  }
  return sample;
}
Observable distribution_trial(Normal& normal, double shift) {
  Observable o;
  o.kind = Kind::distribution;
  o.bins = even_bins(-6, 6, 24);
  for (int run = 0; run < 8; ++run) {
    std::vector<Sample> wedges;
    for (int k = 0; k < 4; ++k) wedges.push_back(histogram(normal, o.bins, 50, 0));
    Sample whole = wedges[0];
    for (int k = 1; k < 4; ++k) {
      const Sample& wedge = wedges[static_cast<std::size_t>(k)];
      whole.content += wedge.content;
      whole.amount += wedge.amount;
    }
    o.reference.push_back(whole);
    o.wedges.push_back(wedges);
    o.compared.push_back(histogram(normal, o.bins, 50, shift));
  }
  return o;
}

}  // namespace

TEST_CASE("Wasserstein distance of laws with known answers") {
  SECTION("two uniform laws, one shifted") {
    const Bins bins = even_bins(0, 4, 40);
    const auto uniform = [](double from) {
      return [from](double x) { return std::min(1.0, std::max(0.0, x - from)); };
    };
    CHECK(wasserstein(bins, law(bins, uniform(1)), law(bins, uniform(1.7))) == Approx(0.7).epsilon(1e-12));
    CHECK(wasserstein(bins, law(bins, uniform(1)), law(bins, uniform(1))) == 0);
  }
  SECTION("two normal laws of different width: the sign changes in the middle of a bin") {
    const Bins bins = even_bins(-20, 20, 2001);  // an odd number: 0 lies inside a bin
    const double s1 = 1, s2 = 1.8;
    const double w = wasserstein(bins, law(bins, [&](double x) { return normal_share(x / s1); }),
                                 law(bins, [&](double x) { return normal_share(x / s2); }));
    CHECK(w == Approx(std::abs(s1 - s2) * std::sqrt(2 / pi)).epsilon(1e-4));
  }
  SECTION("one bin in which the difference changes its sign: two triangles") {
    const Bins bins = even_bins(0, 3, 3);
    const auto at = [&](double a, double b) {
      return law(bins, [a, b](double x) { return x < 0.5 ? 0 : x < 1.5 ? a : x < 2.5 ? b : 1; });
    };
    // gap 0, 0.3, -0.1, 0: pieces 0.15, (0.09 + 0.01) / (2 * 0.4), 0.05
    CHECK(wasserstein(bins, at(0.5, 0.6), at(0.2, 0.7)) == Approx(0.15 + 0.125 + 0.05).epsilon(1e-12));
  }
  SECTION("whole numbers: all grains at 2, all at 5") {
    CHECK(wasserstein(whole_bins(7), whole_numbers({0, 0, 9, 0, 0, 0, 0}), whole_numbers({0, 0, 0, 0, 0, 4, 0})) ==
          Approx(3).epsilon(1e-12));
    CHECK(wasserstein(whole_bins(3), whole_numbers({1, 1, 0}), whole_numbers({0, 1, 1})) == Approx(1));
    CHECK(wasserstein(whole_bins(3), whole_numbers({1, 0, 1}), whole_numbers({0, 2, 0})) == Approx(1));
  }
}

TEST_CASE("Kolmogorov-Smirnov distance of laws with known answers") {
  const Bins bins = even_bins(0, 4, 40);
  const auto uniform = [](double width) { return [width](double x) { return std::min(1.0, x / width); }; };
  CHECK(kolmogorov_smirnov(law(bins, uniform(4)), law(bins, uniform(2))) == Approx(0.5));
  CHECK(kolmogorov_smirnov(whole_numbers({1, 1, 2}), whole_numbers({3, 1, 0})) == Approx(0.5));
  CHECK(kolmogorov_smirnov(whole_numbers({1, 0, 0}), whole_numbers({0, 0, 1})) == 1);
}

TEST_CASE("The mean and the spread of a pooled distribution are those of its law") {
  const Bins bins = even_bins(0, 3, 3);
  const Magnitude even = distribution_magnitude(bins, law(bins, [](double x) { return x / 3; }));
  CHECK(even.mean == Approx(1.5));
  CHECK(even.scale == Approx(3 / std::sqrt(12.0)));
  const Magnitude whole = distribution_magnitude(whole_bins(3), whole_numbers({1, 0, 1}));
  CHECK(whole.mean == Approx(1));
  CHECK(whole.scale == Approx(1));
}

TEST_CASE("Root mean square of weighted maps: cells that one set does not have do not count") {
  // Two runs pool to (2 * 1 + 6 * 5) / 8 = 4 with mean weight 4 in the first cell.
  const Pool first = pool_of({field({2, 1, 3}, {1, 2, 9}), field({6, 1, 3}, {5, 2, 9})});
  CHECK(first.value[0] == Approx(4));
  CHECK(first.weight[0] == Approx(4));
  const Pool second = pool_of({field({2, 1, 0}, {6, 5, 0})});
  // Weights 3 and 1, gaps 2 and 3.
  CHECK(rms_difference(first, second) == Approx(std::sqrt((3 * 4.0 + 1 * 9.0) / 4)));
  CHECK(std::isnan(rms_difference(pool_of({field({1, 0}, {1, 0})}), pool_of({field({0, 1}, {0, 1})}))));
}

TEST_CASE("Student's t and the tails of the expanded percentile interval") {
  CHECK(student_95(1) == Approx(12.7062).epsilon(1e-5));
  CHECK(student_95(8) == Approx(2.30600).epsilon(1e-5));
  CHECK(student_95(30) == Approx(2.04227).epsilon(1e-5));
  CHECK(student_95(1e6) == Approx(1.95996).epsilon(1e-5));
  CHECK(tail_share(1e9, 1e9) == Approx(0.025));
  CHECK(tail_share(10, 9) == Approx(0.5 * std::erfc(2.26216 * std::sqrt(10 / 9.0) / std::sqrt(2.0))).epsilon(1e-4));
  CHECK(quantile({1, 2, 4}, 0.75) == 3);
  CHECK(quantile({7}, 0.3) == 7);
}

TEST_CASE("95 % intervals over seeds cover the true difference") {
  for (const int n : {5, 8}) {
    Normal normal(static_cast<std::uint32_t>(n));
    int covered = 0;
    for (int k = 0; k < 400; ++k) {
      const Observable o = trial(normal, n, n, 1, 0.7);
      const Confidence interval = confidence(o, Measure::difference, quarter);
      REQUIRE(interval.basis == Basis::seeds);
      covered += interval.low < 0.7 && 0.7 < interval.high ? 1 : 0;
    }
    INFO(n << " runs: " << covered);
    CHECK(covered >= 360);
    CHECK(covered <= 392);
  }
}

TEST_CASE("95 % intervals of few runs: over wedges, or from what the runs themselves say") {
  Normal normal(100);
  int over_wedges = 0, own = 0;
  for (int k = 0; k < 400; ++k) {
    Observable o = trial(normal, 2, 3, 0, 0.7);
    const Confidence wedges = confidence(o, Measure::difference, quarter);
    REQUIRE(wedges.basis == Basis::wedges);
    over_wedges += wedges.low < 0.7 && 0.7 < wedges.high ? 1 : 0;
    o.wedges.assign(2, {});
    o.reference_errors.assign(2, 0.5);
    o.compared_errors.assign(3, 1);
    const Confidence told = confidence(o, Measure::difference, quarter);
    REQUIRE(told.basis == Basis::intervals);
    own += told.low < 0.7 && 0.7 < told.high ? 1 : 0;
    CHECK(confidence(o, Measure::rms, quarter).basis == Basis::none);
  }
  INFO("over wedges " << over_wedges << ", own " << own);
  CHECK(over_wedges >= 360);
  CHECK(own >= 360);
  Observable one = trial(normal, 1, 1, 0, 0);
  one.wedges.assign(1, {});
  CHECK(confidence(one, Measure::difference, quarter).basis == Basis::none);
}

TEST_CASE("An interval over wedges has the noise of the sectors and that of the vessels") {
  Observable o;
  o.wedges.resize(1);
  for (int k = 0; k < 100; ++k) o.wedges[0].push_back(scalar(k % 2 == 0 ? -1 : 1));
  o.reference = {scalar(0)};
  o.reference_errors = {std::nan("")};
  for (int k = 0; k < 4; ++k) {
    o.compared.push_back(scalar(5));
    o.compared_errors.push_back(std::nan(""));
  }
  // Four sectors, and a vessel of four wedges: 1/4 + 1/4.
  Confidence interval = confidence(o, Measure::difference, quarter);
  CHECK(interval.high - 5 == Approx(2 * std::sqrt(0.5)).margin(0.15));
  CHECK(5 - interval.low == Approx(2 * std::sqrt(0.5)).margin(0.15));
  // Sectors that say of themselves that they scatter more: 4 / 4 instead of 1 / 4.
  o.compared_errors.assign(4, 2);
  interval = confidence(o, Measure::difference, quarter);
  CHECK(interval.high - 5 == Approx(2 * std::sqrt(1.25)).margin(0.2));
}

TEST_CASE("95 % intervals of distances cover the distance of the laws, also where that is 0") {
  Normal normal(21);
  const auto map = [&](double shift) {  // of 10 cells, each of its own sign
    std::vector<double> values;
    for (int cell = 0; cell < 10; ++cell) values.push_back(3 + (cell % 2 == 0 ? shift : -shift) + normal());
    return field(std::vector<double>(10, 1.0), values);
  };
  for (const double shift : {0.0, 0.3, 2.0}) {
    int rms = 0, wasserstein = 0;
    for (int k = 0; k < 60; ++k) {
      Observable maps;
      maps.kind = Kind::map;
      for (int run = 0; run < 8; ++run) {
        maps.reference.push_back(map(0));
        maps.compared.push_back(map(shift));
      }
      const Confidence of_maps = confidence(maps, Measure::rms, quarter);
      rms += of_maps.low <= shift && shift <= of_maps.high ? 1 : 0;
      const Confidence laws = confidence(distribution_trial(normal, shift / 2), Measure::wasserstein, quarter);
      wasserstein += laws.low <= shift / 2 && shift / 2 <= laws.high ? 1 : 0;
    }
    INFO("shift " << shift << ": rms " << rms << ", Wasserstein " << wasserstein << " of 60");
    CHECK(rms >= 54);
    CHECK(wasserstein >= 54);
  }
}

TEST_CASE("What the yardstick of a set rests on") {
  const YardstickPlan eight = plan_yardstick(quarter, std::vector<std::size_t>(8, 4));
  CHECK(eight.pieces == 32);
  CHECK(eight.growth == Approx(std::sqrt(32 / 31.0)));
  CHECK(eight.widening == Approx(2.03951 / 1.95996).epsilon(1e-4));  // t of 31 degrees of freedom
  CHECK(plan_yardstick(quarter, {4}).one_run);
  CHECK(plan_yardstick({true, 4, 4}, {4, 4, 0}).pieces == 3);
  CHECK(plan_yardstick({true, 1, 1}, {4}).why_not == "one reference run has no spread");
  CHECK(plan_yardstick(quarter, {0, 0}).why_not == "the reference runs have no wedges of this angle");
  for (const auto& few : std::vector<std::vector<std::size_t>>{{2}, {0, 3}, {1, 1, 1}})
    CHECK(plan_yardstick(quarter, few).why_not.find("too few") != std::string::npos);
  CHECK(plan_yardstick(quarter, {0, 1}).why_not ==
        "1 wedge of this angle is too few, at least 4 of all reference runs are needed");
  CHECK(plan_yardstick(quarter, {2, 2}).why_not.empty());
  CHECK(plan_yardstick(quarter, {4}).why_not.empty());
}

TEST_CASE("A sector of the same law is rarely beyond the yardstick, another often") {
  const double same = share_beyond(8, 8, 0, 0, 200, 1);
  CHECK(same <= 0.1);
  CHECK(same >= 0.005);
  CHECK(share_beyond(2, 2, 0, 0, 200, 2) <= 0.12);
  CHECK(share_beyond(8, 8, 0, 2, 50, 3) >= 0.95);
  CHECK(share_beyond(1, 1, 0, 10, 50, 4) >= 0.95);
}

TEST_CASE("A distribution of the same law is rarely beyond the yardstick, another often") {
  Normal normal(9);
  int same = 0, shifted = 0;
  for (int k = 0; k < 60; ++k) {
    for (const ComparisonRow& row : compare(distribution_trial(normal, 0), quarter)) same += row.beyond ? 1 : 0;
    for (const ComparisonRow& row : compare(distribution_trial(normal, 0.3), quarter))
      shifted += row.beyond ? 1 : 0;
  }
  INFO(same << " of the same law and " << shifted << " shifted are beyond, of 120");
  CHECK(same <= 10);
  CHECK(shifted >= 110);
}

TEST_CASE("A row tells means, runs, relative distance and what its interval rests on") {
  Normal normal(11);
  const Observable o = distribution_trial(normal, 0.5);
  const std::vector<ComparisonRow> rows = compare(o, quarter);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].measure == Measure::wasserstein);
  CHECK(rows[1].measure == Measure::kolmogorov_smirnov);
  CHECK(rows[0].relative == Approx(rows[0].value / distribution_magnitude(o.bins, pool_of(o.reference)).scale));
  CHECK(rows[0].value == Approx(rows[0].compared - rows[0].reference).epsilon(0.02));  // a shift
  CHECK(rows[1].relative == rows[1].value);
  CHECK(rows[0].reference_runs == 8);
  CHECK(rows[0].interval.basis == Basis::seeds);
  CHECK(rows[0].interval.low < 0.5);
  CHECK(0.5 < rows[0].interval.high);
  const std::vector<ComparisonRow> again = compare(o, quarter);
  CHECK(comparison_csv(rows) == comparison_csv(again));
}

TEST_CASE("The rounding of a mean is not beyond a yardstick of no width") {
  Observable o;
  o.reference.assign(6, scalar(0.1));
  o.wedges.assign(6, {scalar(0.1), scalar(0.1)});
  o.compared.assign(1, scalar(std::nextafter(0.1, 1.0)));
  CHECK_FALSE(compare(o, {false, 2, 1})[0].beyond);
}

TEST_CASE("Where no wedge differs, only what an interval keeps off 0, or many runs show, is beyond") {
  const auto beyond = [](std::size_t wedges, const std::vector<double>& compared, double own = std::nan("")) {
    Observable o;
    o.reference = {scalar(2)};
    o.reference_errors = {std::nan("")};
    o.wedges = {std::vector<Sample>(wedges, scalar(2))};
    for (const double value : compared) {
      o.compared.push_back(scalar(value));
      o.compared_errors.push_back(own);
    }
    const ComparisonRow row = compare(o, quarter)[0];
    CHECK(row.yardstick.low == 2 - 2);
    CHECK(row.yardstick.high == 2 - 2);
    return row.beyond;
  };
  CHECK_FALSE(beyond(4, {2, 2, 2.3}));  // the interval holds 0
  CHECK(beyond(4, {3, 3.1, 2.9}));
  CHECK_FALSE(beyond(4, {3}, 2));
  CHECK(beyond(4, {3}, 0.2));
  // Neither wedges nor compared runs differ among themselves: n + m equal things fall apart so once in (n + m over
  // m).
  CHECK_FALSE(beyond(4, {3}));
  CHECK_FALSE(beyond(4, {3, 3}));
  CHECK(beyond(4, {3, 3, 3}));
  CHECK_FALSE(beyond(18, {3}));
  CHECK(beyond(19, {3}));
}
