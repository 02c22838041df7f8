// sector_error.cpp: the laws that the study of angles found, with their factors.
#include "apps/commands/sector_error.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "apps/measure/discharge.hpp"
#include "core/grain_sizes.hpp"
#include "core/time_scales.hpp"
#include "io/scene/checks.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

/// error = factor (d / (L theta))^power, L a diameter.
struct SectorLaw {
  const char* quantity;
  double factor, uncertainty;
  int power;
  double doubtful;
};
// Printed by `python3 apps/study/rule.py`: of beds at rest the rows "axis zone", of the rate "flow4".
constexpr SectorLaw vessel_laws[] = {
    {"packing fraction", 4.16, 0.074, 2, 0.02},
    {"coordination number (distinct neighbours)", -3.68, 0.079, 2, 0.02},
};
constexpr SectorLaw rate_law = {"discharge rate of a steady flow", -201, 28, 4, 0.05};
// The same command, of piles on a plate of 32 d, in theta alone.
constexpr SectorLaw pile_laws[] = {
    {"angle of repose (of a plate of 32 d)", -0.105, 0.015, 1, 0.05},
    {"coordination number of the pile (distinct neighbours)", -0.00948, 0.0013, 2, 0.02},
};
// Share that stops: 1 / (1 + exp((theta (D0 / d - rim) - middle) / width)); the same command, "stops".
constexpr double stop_rim = 4.5, stop_middle = 3.65, stop_middle_uncertainty = 0.10, stop_width = 0.49;
constexpr double doubtful_share = 0.05;
const AxisRule studied_axis = Domain().axis;  // the study left the axis as it is when a scene says nothing

// theta D0 / d, an arc of 2 d at the rim: the flow laws were not fitted to thinner sectors.
constexpr double least_rim = 4;

/// "+1.6 +- 0.1 %": as many decimals as the uncertainty has sense, at most two.
std::string percent(double value, double uncertainty) {
  const double in_percent = 100 * uncertainty;
  const int decimals = in_percent >= 1 ? 0 : in_percent >= 0.1 ? 1 : 2;
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << std::showpos << 100 * value << std::noshowpos << " +- "
       << std::max(in_percent, std::pow(10, -decimals)) << " %";
  return text.str();
}

/// The diameter [m] of the ground that is left when a stage takes away a ring around it; 0 where none does.
double plate_diameter(const Scene& scene) {
  for (const Stage& stage : scene.stages) {
    for (const std::string& name : stage.remove) {
      for (const WallDescription& wall : scene.walls) {
        if (wall.name != name || wall.profile.empty()) continue;
        double inner = wall.profile.front().x();
        for (const Eigen::Vector2d& point : wall.profile) inner = std::min(inner, point.x());
        if (inner > 0) return 2 * inner;
      }
    }
  }
  return 0;
}

}  // namespace

SectorExpectation expected_errors(const SectorSize& sector) {
  SectorExpectation expected;
  const auto add = [&](const SectorLaw& law, double length) {
    const double share = std::pow(length * sector.theta, -law.power);
    expected.errors.push_back({law.quantity, law.factor * share, law.uncertainty * share, law.doubtful});
  };
  if (sector.plate > 0 && !(sector.orifice > 0)) {
    for (const SectorLaw& law : pile_laws) add(law, 1);
    return expected;
  }
  for (const SectorLaw& law : vessel_laws) add(law, sector.width);
  if (!(sector.orifice > 0)) return expected;
  expected.thin_at_orifice = sector.theta * sector.orifice < least_rim;
  if (expected.thin_at_orifice) return expected;
  add(rate_law, sector.orifice);
  const double share = 1 / (1 + std::exp((sector.theta * (sector.orifice - stop_rim) - stop_middle) / stop_width));
  expected.stopped_share = share;
  expected.stopped_uncertainty = share * (1 - share) / stop_width * stop_middle_uncertainty;
  return expected;
}

std::optional<SectorExpectation> expected_errors(const Scene& scene) {
  const Domain& domain = scene.domain;
  const double diameter = mean_diameter(scene.particles), radius = widest_radius(scene);
  if (domain.kind != DomainKind::sector || domain.sides != Sides::periodic || domain.axis != studied_axis ||
      !(diameter > 0 && radius > 0))
    return std::nullopt;
  return expected_errors({2 * numbers::pi / domain.order, 2 * radius / diameter, orifice_diameter(scene) / diameter,
                          plate_diameter(scene) / diameter});
}

std::string expectation_text(const SectorExpectation& expected) {
  std::string text;
  for (const ExpectedError& e : expected.errors)
    text += (text.empty() ? "" : ", ") + e.quantity + ' ' + percent(e.error, e.uncertainty);
  if (expected.thin_at_orifice)
    text += "; too thin at the orifice (an arc below 2 d): its flow says nothing about the full vessel's";
  if (expected.stopped_share)
    text += "; an arch stops or interrupts " + number_text(std::round(100 * *expected.stopped_share)) + " +- " +
            number_text(std::max(1.0, std::round(100 * expected.stopped_uncertainty))) + " % of such sectors";
  return text;
}

std::optional<std::string> expectation_warning(const Scene& scene) {
  const Domain& domain = scene.domain;
  if (domain.kind == DomainKind::sector && domain.sides != Sides::periodic)
    return std::string(
        "the sides of this sector are walls: neither its bed nor its flow matches the full vessel's "
        "(apps/study/README.md, \"What bounds a sector\")");
  const std::optional<SectorExpectation> expected = expected_errors(scene);
  if (!expected) return std::nullopt;
  const bool wrong = std::any_of(expected->errors.begin(), expected->errors.end(),
                                 [](const ExpectedError& e) { return std::abs(e.error) > e.doubtful; });
  if (!wrong && !expected->thin_at_orifice && !(expected->stopped_share.value_or(0) > doubtful_share))
    return std::nullopt;
  return number_text(360.0 / domain.order) +
         " degrees: expected deviations from the full vessel (apps/study/README.md): " +
         expectation_text(*expected) + ". Use a larger angle, or several seeds and the full vessel once";
}

}  // namespace wedge
