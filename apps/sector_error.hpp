// sector_error.hpp: how far a sector is expected to be from the full vessel, by the study of angles in apps/study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

/// A quantity's expected relative error, with its standard error.
struct ExpectedError {
  std::string quantity;
  double error = 0, uncertainty = 0;  // parts of the full vessel's value
};

/// What is expected of a sector with periodic sides and the axis `clamp`.
struct SectorExpectation {
  bool thin_at_orifice = false;  // its arc at the rim is below 2 d: no discharge rate can be expected of it
  std::vector<ExpectedError> errors;
  std::optional<double> arched_share;  // of sectors that a stable arch stops; nothing without an orifice
  double arched_uncertainty = 0;       // its standard error
};

/// Errors at rest: a (d / (D theta))^2, the share of the vessel's cross section that a core of some arcs of d takes
/// (theta in rad, D the vessel's diameter); of the discharge rate a (d / (D0 theta))^4, D0 the orifice's diameter;
/// without an orifice, a / theta of a pile's angle of repose. Factors a and arches: apps/study/rule.py, from the
/// runs of apps/study. `orifice` is 0 where there is none.
SectorExpectation expected_errors(double theta, double width_in_diameters, double orifice_in_diameters);

/// The same of a scene; nothing for a full vessel, a slot, other sides or another axis, which the law is not made
/// for.
std::optional<SectorExpectation> expected_errors(const Scene& scene);

/// "packing fraction +1.6 +- 0.1 %, ...", one line.
std::string expectation_text(const SectorExpectation& expected);

/// Where an error of more than 2 % or an arch in more than 5 % of the runs is to be expected: what to say of it.
std::optional<std::string> expectation_warning(const Scene& scene);

}  // namespace wedge
