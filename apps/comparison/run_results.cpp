// run_results.cpp: reading of scalars.csv, distributions.csv, radial.csv and map.csv of a run.
#include "apps/comparison/run_results.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <tuple>

#include "apps/comparison/result_file.hpp"
#include "apps/results/run_folder.hpp"
#include "apps/results/vocabulary.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/scene_file.hpp"

namespace wedge {
namespace {

const char* const table_names[] = {"scalars.csv", "distributions.csv", "radial.csv", "map.csv"};
const char* const summary_name = "summary.json";

std::string path_of(const RunResults& run, const std::string& file) {
  return RunFolder(run.folder).results() + "/" + file;
}

bool there(const RunResults& run, const std::string& file) {
  return std::find(run.missing.begin(), run.missing.end(), file) == run.missing.end();
}

template <class T>
void note(std::vector<T>& list, const T& entry) {
  if (std::find(list.begin(), list.end(), entry) == list.end()) list.push_back(entry);
}

const ResultQuantity& known(const ResultFile& file, const std::string& name, ResultTable table) {
  const ResultQuantity* found = find_quantity(name);
  if (found == nullptr || !found->is_in(table)) file.refuse_name(name, "a quantity of this table");
  return *found;
}

/// What is read of the files of a run.
class Reader {
public:
  Reader(RunResults& run, int wedge_order) : run_(run), wedge_order_(wedge_order) {}

  void scalars() {
    ResultFile file(path_of(run_, "scalars.csv"));
    const std::size_t quantity = file.column("quantity"), value = file.column("value"), low = file.column("low"),
                      high = file.column("high");
    while (next(file)) {
      known(file, file.text(quantity), in_scalars);
      const ResultName name{file.text(0), file.text(1), name_of(RegionKind::all), file.text(quantity)};
      run_.scalars[name] = {file.number(value), file.number(low), file.number(high)};
    }
  }

  void distributions() {
    ResultFile file(path_of(run_, "distributions.csv"));
    const std::size_t region = file.column("region"), quantity = file.column("quantity"),
                      scale = file.column("scale"), step = file.column("step"), first = file.column("first"),
                      counts = file.column("counts");
    while (next(file)) {
      known(file, file.text(quantity), in_distributions);
      if (!region_of(file.text(region))) file.refuse_name(file.text(region), "a region");
      const ResultName name{file.text(0), file.text(1), file.text(region), file.text(quantity)};
      run_.distributions[name] =
          distribution(file, file.number(scale), file.number(step), file.number(first), file.numbers(counts));
    }
  }

  /// radial.csv or map.csv.
  void fields(const char* file_name, ResultTable table, Fields& fields) {
    ResultFile file(path_of(run_, file_name));
    const bool map = table == in_map;
    const std::size_t r = file.column("r"), weight = file.column(row_weight), z = map ? file.column("z") : r;
    std::vector<std::size_t> compared;
    for (std::size_t k = 2; k < file.headings().size(); ++k)
      if (known(file, file.headings()[k].name, table).compared() && k != weight) compared.push_back(k);
    while (next(file)) {
      FieldResult& field = fields[{file.text(0), file.text(1)}];
      field.r.push_back(file.number(r));
      if (map) field.z.push_back(file.number(z));
      field.weight.push_back(file.number(weight));
      for (std::size_t n = 0; n < compared.size(); ++n) {
        if (n == field.columns.size()) field.columns.push_back({file.headings()[compared[n]].name, {}});
        field.columns[n].values.push_back(file.number(compared[n]));
      }
    }
  }

private:
  /// Goes on to the next row of the whole or of a wanted wedge.
  bool next(ResultFile& file) {
    if (!file.next([&](PartId part) { return part.whole() || part.sectors == wedge_order_; })) return false;
    note(run_.moments, file.text(0));
    if (!file.part().whole()) note(run_.wedges, file.text(1));
    return true;
  }

  static DistributionResult distribution(const ResultFile& file, double scale, double step, double first,
                                         const std::vector<double>& counts) {
    const bool sound =
        step >= 0 && scale > 0 && std::isfinite(scale) && std::isfinite(step) && std::isfinite(first);
    if (!sound) file.refuse("scale must be above 0, step at least 0, and first a number");
    DistributionResult result;
    result.whole_numbers = step == 0;
    const auto n = static_cast<Eigen::Index>(counts.size());
    result.edges.resize(n + 1);
    result.counts.resize(n);
    for (Eigen::Index k = 0; k <= n; ++k) {
      const double m = first + static_cast<double>(k);
      result.edges[k] = step == 0 ? m - 0.5 : scale * std::sinh(m * step);
      if (k < n) result.counts[k] = counts[static_cast<std::size_t>(k)];
    }
    if (!result.edges.allFinite() || !(result.counts >= 0).all() || !result.counts.allFinite())
      file.refuse("counts must be at least 0 and edges finite");
    return result;
  }

  RunResults& run_;
  int wedge_order_;
};

/// The measured mean diameter of the grains [m], from summary.json.
double measured_diameter(const std::string& path) {
  const auto summary = nlohmann::json::parse(read_text_file(path), nullptr, false);
  const nlohmann::json::json_pointer place("/domain/diameter_m");
  if (summary.is_discarded() || !summary.contains(place) || !summary.at(place).is_number())
    throw FileError(path + ": holds no domain.diameter_m; measure the run again: wedge analyse DIR");
  return summary.at(place).get<double>();
}

}  // namespace

bool operator<(const ResultName& a, const ResultName& b) {
  return std::tie(a.moment, a.part, a.region, a.quantity) < std::tie(b.moment, b.part, b.region, b.quantity);
}

RunResults read_domain(const std::string& folder) {
  const RunFolder run(folder);
  run.require_run();
  RunResults result;
  result.folder = folder;
  for (const char* file : table_names)
    if (!std::filesystem::exists(path_of(result, file))) result.missing.push_back(file);
  if (!analysed(result)) return result;
  const Scene scene = read_scene(run.resolved_scene(), {});
  result.slot = scene.domain.kind == DomainKind::slot;
  result.order = scene.domain.order;
  const std::string summary = path_of(result, summary_name);
  if (std::filesystem::exists(summary))
    result.diameter = measured_diameter(summary);
  else
    result.missing.push_back(summary_name);
  return result;
}

bool analysed(const RunResults& run) { return run.missing.size() < std::size(table_names); }

int widest_wedges(const RunResults& run) {
  int fewest = 0;  // sectors in a vessel
  for (const char* file_name : {"scalars.csv", "radial.csv"}) {
    if (fewest > 0 || !there(run, file_name)) continue;
    ResultFile file(path_of(run, file_name));
    const auto is_wider = [&](PartId part) { return !part.whole() && (fewest == 0 || part.sectors < fewest); };
    while (file.next(is_wider)) fewest = file.part().sectors;
  }
  return fewest;
}

void read_results(RunResults& run, int wedge_order) {
  Reader reader(run, wedge_order);
  if (there(run, "scalars.csv")) reader.scalars();
  if (there(run, "distributions.csv")) reader.distributions();
  if (there(run, "radial.csv")) reader.fields("radial.csv", in_profile, run.rings);
  if (there(run, "map.csv")) reader.fields("map.csv", in_map, run.cells);
}

}  // namespace wedge
