// sector_error.cpp: the laws that the study of angles found, with their factors.
#include "apps/sector_error.hpp"

#include <algorithm>
#include <cmath>

#include "apps/analysis/discharge.hpp"
#include "core/grain_sizes.hpp"
#include "core/time_scales.hpp"
#include "io/csv.hpp"
#include "io/scene_checks.hpp"

namespace wedge {
namespace {

/// error = factor (d / (L theta))^power, L the diameter of the vessel or that of the orifice.
struct SectorLaw {
  const char* quantity;
  double factor, uncertainty;
  int power;
};
// Printed by `python3 apps/study/rule.py`: rows "core" of the first, "flow4" of the rate.
constexpr SectorLaw vessel_laws[] = {
    {"packing fraction", 4.0, 0.1, 2},
    {"coordination number (distinct neighbours)", -3.6, 0.1, 2},
};
constexpr SectorLaw rate_law = {"discharge rate where it flows", -290, 30, 4};
// error = factor / theta, of a pile on a plate of 32 d; the same command, "angle of repose".
constexpr SectorLaw pile_law = {"angle of repose of a pile", -0.10, 0.02, 1};
// Share of arched sectors: 1 / (1 + exp((theta (D0 / d - rim) - middle) / width)); the same command, "arches".
constexpr double arch_rim = 5, arch_middle = 2.85, arch_middle_uncertainty = 0.1, arch_width = 0.31;

// theta D0 / d, an arc of 2 d at the rim: thinner ones are not what these laws are of.
constexpr double least_rim = 4;

constexpr double doubtful_error = 0.02, doubtful_share = 0.05;

/// Of a number in parts of one; with two decimals below 1 %, else with one.
std::string percent(double share) {
  const double decimals = std::abs(share) < 0.01 ? 100 : 10;
  return number_text(std::round(100 * decimals * share) / decimals);
}

}  // namespace

SectorExpectation expected_errors(double theta, double width_in_diameters, double orifice_in_diameters) {
  SectorExpectation expected;
  const auto add = [&](const SectorLaw& law, double length_in_diameters) {
    const double share = std::pow(length_in_diameters * theta, -law.power);
    expected.errors.push_back({law.quantity, law.factor * share, law.uncertainty * share});
  };
  for (const SectorLaw& law : vessel_laws) add(law, width_in_diameters);
  if (!(orifice_in_diameters > 0)) {
    add(pile_law, 1);
    return expected;
  }
  expected.thin_at_orifice = theta * orifice_in_diameters < least_rim;
  if (!expected.thin_at_orifice) add(rate_law, orifice_in_diameters);
  const double share = 1 / (1 + std::exp((theta * (orifice_in_diameters - arch_rim) - arch_middle) / arch_width));
  expected.arched_share = share;
  expected.arched_uncertainty = share * (1 - share) / arch_width * arch_middle_uncertainty;
  return expected;
}

std::optional<SectorExpectation> expected_errors(const Scene& scene) {
  const Domain& domain = scene.domain;
  const double diameter = mean_diameter(scene.particles), radius = widest_radius(scene);
  if (domain.kind != DomainKind::sector || domain.sides != Sides::periodic || domain.axis != AxisRule::clamp ||
      !(diameter > 0 && radius > 0))
    return std::nullopt;
  return expected_errors(2 * numbers::pi / domain.order, 2 * radius / diameter, orifice_diameter(scene) / diameter);
}

std::string expectation_text(const SectorExpectation& expected) {
  std::string text;
  for (const ExpectedError& e : expected.errors)
    text += (text.empty() ? "" : ", ") + e.quantity + (e.error > 0 ? " +" : " ") + percent(e.error) + " +- " +
            percent(e.uncertainty) + " %";
  if (expected.thin_at_orifice) text += "; at the orifice it is too thin (an arc below 2 d) for a discharge rate";
  if (expected.arched_share)
    text += "; an arch stops " + number_text(std::round(100 * *expected.arched_share)) + " +- " +
            number_text(std::max(1.0, std::round(100 * expected.arched_uncertainty))) + " % of such sectors";
  return text;
}

std::optional<std::string> expectation_warning(const Scene& scene) {
  const std::optional<SectorExpectation> expected = expected_errors(scene);
  if (!expected) return std::nullopt;
  const bool wrong = std::any_of(expected->errors.begin(), expected->errors.end(),
                                 [](const ExpectedError& e) { return std::abs(e.error) > doubtful_error; });
  if (!wrong && !(expected->arched_share.value_or(0) > doubtful_share)) return std::nullopt;
  return number_text(360.0 / scene.domain.order) +
         " degrees here: expected against the full vessel (apps/study/README.md): " + expectation_text(*expected) +
         ". Use a larger angle, or several seeds and the full vessel once";
}

}  // namespace wedge
