// bed_table.hpp: what a bed is like at the end of a stage, as one row of numbers for the whole vessel.
#pragma once

#include <string>
#include <vector>

#include "core/scene.hpp"
#include "core/state.hpp"

namespace wedge {

/// A quantity of a bed. Extensive ones of a sector are multiplied by the number of sectors.
struct BedQuantity {
  std::string name, unit;
  double value = 0;
};

struct StageResult {
  std::string stage;
  std::vector<BedQuantity> quantities;  // the same names in the same order for every stage of a run
};

/// Measures the bed; `discharge_rate` [1/s] of the domain and `wall_seconds` of the stage come from the run's
/// driver.
StageResult measure_bed(const State& state, const Scene& scene, const std::string& stage, double discharge_rate,
                        double wall_seconds);

/// Writes and reads RunFolder::beds(). Throws FileError.
void write_bed_table(const std::string& path, const std::vector<StageResult>& stages);
std::vector<StageResult> read_bed_table(const std::string& path);

/// Picture (SVG) of the grains within 2 mean diameters of the plane y = 0, a sector unfolded to the whole vessel,
/// coloured by speed, with the walls and a colour bar; its title names scene, domain, stage and time. Throws
/// FileError.
void write_slice_svg(const std::string& path, const State& state, const Scene& scene, const std::string& stage);

}  // namespace wedge
