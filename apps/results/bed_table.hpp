// bed_table.hpp: results/beds.csv: what the bed was like at the end of each stage, as rows of numbers.
#pragma once

#include <string>
#include <vector>

namespace wedge {

/// A number of a bed, by the vocabulary or the load on one wall.
struct BedQuantity {
  std::string name, unit;
  double value = 0;
};

struct StageResult {
  std::string stage;
  std::vector<BedQuantity> quantities;  // the same names in the same order for every stage of a run
};

/// Writes and reads RunFolder::beds(). Throws FileError.
void write_bed_table(const std::string& path, const std::vector<StageResult>& stages);
std::vector<StageResult> read_bed_table(const std::string& path);

}  // namespace wedge
