// sector_error.hpp: how far a sector is expected to be from the full vessel, by the study of angles in apps/study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace wedge {

/// What the laws of the study take of a sector. Lengths in mean grain diameters.
struct SectorSize {
  double theta = 0;    // rad
  double width = 0;    // D, of the vessel
  double orifice = 0;  // D0, of a hole that opens on the axis; 0: none
  double plate = 0;  // of a pile: diameter of the ground that stays when the ring around it is taken away; 0: none
};

/// A quantity's expected relative error, with its standard error.
struct ExpectedError {
  std::string quantity;
  double error = 0, uncertainty = 0;  // parts of the full vessel's value, of the mean over many runs
  double doubtful = 0;                // an error beyond this deserves a warning
};

/// What is expected of a sector with periodic sides and the axis `clamp`.
struct SectorExpectation {
  std::vector<ExpectedError> errors;
  bool thin_at_orifice = false;         // its arc at the rim is below 2 d: nothing can be expected of its flow
  std::optional<double> stopped_share;  // of sectors that an arch stops or interrupts; nothing without a flow
  double stopped_uncertainty = 0;       // its standard error
};

/// Errors of a bed at rest: a (d / (D theta))^2, the share of the vessel's cross section that an axis zone of some
/// arcs of d takes; of the discharge rate a (d / (D0 theta))^4; of a pile's angle of repose a / theta, of its
/// coordination number a / theta^2. Factors a and the share that stops: apps/study/rule.py, from the runs of
/// apps/study.
SectorExpectation expected_errors(const SectorSize& sector);

/// The same of a scene; nothing for a full vessel, a slot, other sides or another axis, which the laws are not of.
std::optional<SectorExpectation> expected_errors(const Scene& scene);

/// "packing fraction +1.6 +- 0.1 %, ...", one line.
std::string expectation_text(const SectorExpectation& expected);

/// What to say of a sector of which large errors (2 % at rest, 5 % of a rate or an angle) or stops in more than 5 %
/// of the runs are to be expected, or whose sides are walls.
std::optional<std::string> expectation_warning(const Scene& scene);

}  // namespace wedge
