// run_results.cpp: reading of scalars.csv, distributions.csv, radial.csv and map.csv of a run.
#include "apps/comparison/run_results.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <tuple>

#include "apps/comparison/result_file.hpp"
#include "apps/results/run_folder.hpp"
#include "core/grain_sizes.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/scene/scene_file.hpp"

namespace wedge {
namespace {

const char* const file_names[] = {"scalars.csv", "distributions.csv", "radial.csv", "map.csv"};

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

/// What is read of the files of a run.
class Reader {
public:
  Reader(RunResults& run, int wedge_order) : run_(run) {
    if (wedge_order > 0) prefix_ = "wedge_" + angle_text(wedge_order) + "_";
  }

  void scalars() {
    ResultFile file(path_of(run_, "scalars.csv"));
    const std::size_t quantity = file.column("quantity"), unit = file.column("unit"), value = file.column("value"),
                      low = file.column("low"), high = file.column("high");
    while (next(file)) {
      const ResultName name{file.text(0), file.text(1), "all", file.text(quantity)};
      run_.scalars[name] = {file.text(unit), file.number(value), file.number(low), file.number(high)};
      if (seen_.insert({name.moment, "", "scalar", name.quantity}).second)
        run_.scalar_names.push_back({name.moment, "", name.region, name.quantity});
    }
  }

  void distributions() {
    ResultFile file(path_of(run_, "distributions.csv"));
    const std::size_t region = file.column("region"), quantity = file.column("quantity"),
                      unit = file.column("unit"), scale = file.column("scale"), step = file.column("step"),
                      first = file.column("first"), counts = file.column("counts");
    while (next(file)) {
      const ResultName name{file.text(0), file.text(1), file.text(region), file.text(quantity)};
      run_.distributions[name] = distribution(file, file.text(unit), file.number(scale), file.number(step),
                                              file.number(first), file.numbers(counts));
      const ResultName of_any{name.moment, "", name.region, name.quantity};
      if (seen_.insert(of_any).second) run_.distribution_names.push_back(of_any);
    }
  }

  /// radial.csv or map.csv.
  void fields(const char* file_name, Fields& fields) {
    ResultFile file(path_of(run_, file_name));
    const bool map = &fields == &run_.cells;
    const std::size_t r = file.column("r"), grains = file.column("grains"), z = map ? file.column("z") : r;
    while (next(file)) {
      FieldResult& field = fields[{file.text(0), file.text(1)}];
      field.r.push_back(file.number(r));
      if (map) field.z.push_back(file.number(z));
      field.weight.push_back(file.number(grains));
      std::size_t column = 0;
      for (std::size_t k = 2; k < file.headings().size(); ++k) {
        const Heading& heading = file.headings()[k];
        // Coordinates, the weight, and numbers of zones, of which there is no mean.
        if (k == r || k == z || k == grains || heading.name == "arc" || heading.name == "zone") continue;
        if (column == field.columns.size()) field.columns.push_back({heading.name, heading.unit, {}});
        field.columns[column++].values.push_back(file.number(k));
      }
    }
  }

private:
  bool next(ResultFile& file) {
    const bool found = file.next([&](const std::string& part) {
      return part == "whole" || (!prefix_.empty() && part.compare(0, prefix_.size(), prefix_) == 0);
    });
    if (!found) return false;
    note(run_.moments, file.text(0));
    if (file.text(1) != "whole") note(run_.wedges, file.text(1));
    return true;
  }

  static DistributionResult distribution(const ResultFile& file, const std::string& unit, double scale, double step,
                                         double first, const std::vector<double>& counts) {
    const bool sound =
        step >= 0 && scale > 0 && std::isfinite(scale) && std::isfinite(step) && std::isfinite(first);
    if (!sound) file.refuse("scale must be above 0, step at least 0, and first a number");
    DistributionResult result;
    result.unit = unit;
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
  std::string prefix_;
  std::set<ResultName> seen_;
};

}  // namespace

bool operator<(const ResultName& a, const ResultName& b) {
  return std::tie(a.moment, a.part, a.region, a.quantity) < std::tie(b.moment, b.part, b.region, b.quantity);
}

std::string angle_text(int order) { return short_number(360.0 / order); }

RunResults read_domain(const std::string& folder) {
  const RunFolder run(folder);
  run.require_run();
  RunResults result;
  result.folder = folder;
  for (const char* file : file_names)
    if (!std::filesystem::exists(run.results() + "/" + file)) result.missing.push_back(file);
  if (!analysed(result)) return result;
  const Scene scene = read_scene(run.resolved_scene(), {});
  result.slot = scene.domain.kind == DomainKind::slot;
  result.order = scene.domain.order;
  result.diameter = mean_diameter(scene.particles);
  return result;
}

bool analysed(const RunResults& run) { return run.missing.size() < std::size(file_names); }

int widest_wedges(const RunResults& run) {
  double widest = 0;
  for (const char* file_name : {"scalars.csv", "radial.csv"}) {
    if (widest > 0 || !there(run, file_name)) continue;
    ResultFile file(path_of(run, file_name));
    const std::string prefix = "wedge_";
    while (file.next([&](const std::string& part) { return part.compare(0, prefix.size(), prefix) == 0; })) {
      const std::string rest = file.text(1).substr(prefix.size());
      double angle = 0;
      if (parse_number(rest.substr(0, rest.find('_')), angle) == NumberError::none)
        widest = std::max(widest, angle);
    }
  }
  return widest > 0 ? static_cast<int>(std::lround(360 / widest)) : 0;
}

void read_results(RunResults& run, int wedge_order) {
  Reader reader(run, wedge_order);
  if (there(run, "scalars.csv")) reader.scalars();
  if (there(run, "distributions.csv")) reader.distributions();
  if (there(run, "radial.csv")) reader.fields("radial.csv", run.rings);
  if (there(run, "map.csv")) reader.fields("map.csv", run.cells);
}

}  // namespace wedge
