// run_results.hpp: what `wedge analyse` has written of one run, as far as a comparison needs it.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace wedge {

/// A scalar or a distribution of a file: moment, part, region (of a distribution) and quantity name it.
struct ResultName {
  std::string moment, part, region, quantity;
};
bool operator<(const ResultName& a, const ResultName& b);

struct ScalarResult {
  double value = 0, low = 0, high = 0;  // nan: not known
};

struct DistributionResult {
  Eigen::ArrayXd edges;   // one more than counts
  Eigen::ArrayXd counts;  // grains between two edges
  bool whole_numbers = false;
};

struct FieldColumn {
  std::string quantity;
  std::vector<double> values;  // nan: not known
};
/// Rows of radial.csv (no heights) or map.csv of one moment and part.
struct FieldResult {
  std::vector<double> r, z, weight;
  std::vector<FieldColumn> columns;
};
using Fields = std::map<std::pair<std::string, std::string>, FieldResult>;  // by moment and part

struct RunResults {
  std::string folder;
  bool slot = false;
  int order = 1;                     // 360 degrees / angle
  double diameter = 0;               // m, measured mean of the grains at the start; 0: not known
  std::vector<std::string> missing;  // files of the analysis that are not there
  std::vector<std::string> moments;  // in the order of the files
  std::vector<std::string> wedges;   // parts that are wedges, of the order asked for
  std::map<ResultName, ScalarResult> scalars;
  std::map<ResultName, DistributionResult> distributions;
  Fields rings, cells;
};

/// Domain and diameter of a run, and which of its files are missing; nothing else yet. Throws SceneError for the
/// scene, FileError for a summary.json that is none.
RunResults read_domain(const std::string& folder);
/// Whether anything of an analysis is there.
bool analysed(const RunResults& run);
/// 360 degrees / angle of the widest wedges cut from a run; 0: none are. Throws FileError.
int widest_wedges(const RunResults& run);
/// Reads the files into `run`: part `whole` and the wedges of `wedge_order`. Throws FileError, with file and line,
/// where a file is not as apps/analysis/README.md has it.
void read_results(RunResults& run, int wedge_order);

}  // namespace wedge
