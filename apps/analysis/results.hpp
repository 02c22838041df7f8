// results.hpp: the files of an analysis (README.md of this folder has their formats).
#pragma once

#include <string>
#include <vector>

#include "apps/analysis/moment_sums.hpp"
#include "apps/analysis/moments.hpp"
#include "apps/analysis/pictures.hpp"
#include "apps/measure/discharge.hpp"

namespace wedge {

/// What was found of one moment in one part.
struct PartResult {
  const PartSums* sums = nullptr;
  std::vector<Scalar> scalars;  // those of the sums, and those of the discharge
  double plug_speed = 0;        // m/s, v0 of the zones; 0: no discharge
};
struct MomentResult {
  Moment moment;
  std::vector<PartResult> parts;
};
enum class Zone { none, stagnant, plug, converging };
/// Zone of a cell: see `zone` of the vocabulary.
Zone zone_of(double packing, double vr, double vz, double plug_speed);
/// Volumes [m3] of the stagnant, plug and converging zones.
std::vector<double> zone_volumes(const PartSums& sums, double plug_speed);

/// Fields of a cell in the units of map.csv.
struct CellFields {
  double grains = 0, packing = 0, cn = 0, cn_near = 0, cn_distinct = 0;
  Vec3 velocity;
  double prr = 0, ptt = 0, pzz = 0, prz = 0;
};
CellFields cell_fields(const PartSums& sums, int column, int row);

/// Text of each file. Numbers have five digits, those of the map four.
std::string scalars_csv(const std::vector<MomentResult>& results);
std::string distributions_csv(const std::vector<MomentResult>& results);
std::string radial_csv(const std::vector<MomentResult>& results);
std::string map_csv(const std::vector<MomentResult>& results);
std::string flow_csv(const AnalysedRun& run, const std::vector<Crossing>& crossings, double until);
std::string summary_json(const AnalysedRun& run, const std::vector<MomentResult>& results);

/// Rows of pictures are added moment by moment; the first call gives the heading.
void append_slice(std::string& grains, std::string& lines, const std::string& moment, const SlicePicture& picture);
void append_cut(std::string& text, const std::string& moment, const std::vector<PictureGrain>& grains);

}  // namespace wedge
