// analysed_run.hpp: what every measure needs to know of a run, and the parts and regions it is measured in.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/results/run_folder.hpp"
#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// Where the core of a sector ends, as an arc in mean diameters (Yang et al. 2014: its coordination number deviates
/// below).
inline constexpr double core_arc = 4;

struct AnalysedRun {
  RunFolder folder;
  Scene scene;
  Symmetry symmetry;       // none where the sides are solid
  double diameter = 0;     // m, mean
  double radius = 0;       // m, of the widest wall; of a slot half its width along x
  double left = 0;         // m: of a slot its lowest x, else 0
  double lowest_wall = 0;  // m
  double theta = 0;        // rad, sector angle; 2 pi for a full vessel and a slot
  int order = 1;           // sectors that make the vessel
  bool slot = false;

  /// Of the whole vessel [m2], at its widest place.
  double cross_section() const;
  double gravity() const { return scene.domain.gravity.norm(); }
};

/// The run of a scene with walls, without looking into its folder. `diameter` [m]: mean of its grains. Throws
/// FileError when there is no wall.
AnalysedRun describe_run(const RunFolder& folder, Scene scene, double diameter);
/// Throws FileError when the folder holds no run or a run without frames.
AnalysedRun open_run(const std::string& folder);

/// A range of distances from the axis [m]; `name` is "all", "core_90", "rest_90", ...
struct Region {
  std::string name;
  double from = 0, to = std::numeric_limits<double>::infinity();
  bool holds(double r) const { return r >= from && r < to; }
};

/// All grains of the domain, or those of a wedge cut from a full vessel.
struct Part {
  std::string name = "whole";
  double begin = 0;  // rad, azimuth where it begins
  double angle = 0;  // rad, its width; that of the domain for `whole`
  int copies = 1;    // of it that make the vessel
  bool whole = true;
  std::vector<Region> regions;       // `all` first
  bool holds(double azimuth) const;  // Pre: azimuth in [0, 2 pi)
};

struct PartRequest {
  std::vector<int> orders = {4, 6, 8, 12};  // sectors in a vessel: the cores of a full vessel, and its wedges
  int wedges = 0;                           // of each of them
};
/// `whole` first. Wedges only of a full vessel, at most as many as it has.
std::vector<Part> make_parts(const AnalysedRun& run, const PartRequest& request);

/// Sector angle in degrees as it stands in names: "90", "22.5".
std::string degrees_text(int order);

}  // namespace wedge
