// bed_table.cpp: a bed measured as one row of numbers, and the table of such rows.
#include "apps/run/bed_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/measure/flank.hpp"
#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "kernels/passes/measure.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

std::size_t grain_count(const State& state) { return static_cast<std::size_t>(state.particles.count()); }

double sphere_volume(double radius) { return sphere_mass(radius, 1.0); }  // m3

/// Lowest point of the walls [m]: what is below has left the bed and falls towards the outlet.
double lowest_wall(const Scene& scene) {
  double low = std::numeric_limits<double>::infinity();
  for (const WallDescription& wall : scene.walls)
    for (const Eigen::Vector2d& point : wall.profile) low = std::min(low, point.y());
  return std::isfinite(low) ? low : -std::numeric_limits<double>::infinity();
}

/// Grains of the bed (see lowest_wall) sorted by height.
class Heights {
public:
  Heights(const State& state, const Scene& scene) {
    const Array<double>& z = state.particles.position.z;
    const double low = lowest_wall(scene);
    for (std::size_t i = 0; i < grain_count(state); ++i)
      if (z[i] >= low) order_.push_back(i);
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return z[a] < z[b]; });
  }
  /// Place in the order below which the part `share` of all grains lies.
  std::size_t place(double share) const {
    return static_cast<std::size_t>(share * static_cast<double>(order_.size() - 1));
  }
  std::size_t grain(std::size_t place) const { return order_[place]; }
  std::size_t count() const { return order_.size(); }

private:
  std::vector<std::size_t> order_;
};

/// Cross section of the domain [m2]: that of its widest place.
double cross_section(const State& state, const Scene& scene) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const WallDescription& wall : scene.walls) {
    for (const Eigen::Vector2d& point : wall.profile) {
      low = std::min(low, point.x());
      high = std::max(high, point.x());
    }
  }
  if (!(high >= low)) return not_known;
  if (scene.domain.kind == DomainKind::slot) return (high - low) * scene.domain.slot_width;
  return numbers::pi * high * high / std::max(scene.domain.order, state.symmetry.order());
}

/// Volume of the grains between the 10 % and 70 % quantiles of height, per volume between these heights.
double packing_fraction(const State& state, const Scene& scene) {
  const Heights heights(state, scene);
  if (heights.count() < 2) return not_known;
  const std::size_t low = heights.place(0.1), high = heights.place(0.7);
  double volume = 0;
  for (std::size_t k = low; k < high; ++k) volume += sphere_volume(state.particles.radius[heights.grain(k)]);
  const Array<double>& z = state.particles.position.z;
  const double height = z[heights.grain(high)] - z[heights.grain(low)];
  return height > 0 ? volume / (cross_section(state, scene) * height) : not_known;
}

/// Touching neighbours per grain, by overlap; walls do not count. A grain's contact with its own copy half a turn
/// away is one contact seen from both ends, so it counts once; every other row counts at both of its ends.
double coordination_number(const State& state, const Scene& scene) {
  const ContactTable& c = state.contacts;
  const Array<double>& z = state.particles.position.z;
  const double low = lowest_wall(scene), grains = static_cast<double>(Heights(state, scene).count());
  if (grains == 0) return not_known;
  double ends = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(c.rows()); ++k) {
    if (!(row_overlap(state, k) > 0)) continue;
    const auto first = static_cast<std::size_t>(c.first[k]), second = static_cast<std::size_t>(c.second[k]);
    if (z[first] >= low) ends += 1;
    if (z[second] >= low && !row_is_shared(state, k)) ends += 1;
  }
  return ends / grains;
}

/// Height [m] below which 95 % of the grains lie, a mean radius on top.
double bed_height(const State& state, const Scene& scene) {
  const Heights heights(state, scene);
  if (heights.count() == 0) return not_known;
  return state.particles.position.z[heights.grain(heights.place(0.95))] + 0.5 * state.mean_diameter;
}

/// What a pile of this height stands on [m]: the highest wall that reaches the axis below its peak, else the
/// lowest point of the grains.
double ground(const State& state, double peak) {
  double height = -std::numeric_limits<double>::infinity();
  for (int w = 0; w < state.vessel.wall_count(); ++w) {
    if (!state.vessel.present(w)) continue;
    for (const Eigen::Vector2d& point : state.vessel.wall(w).profile) {
      const double z = point.y() + state.vessel.travel(w);
      if (point.x() == 0 && z < peak) height = std::max(height, z);
    }
  }
  if (std::isfinite(height)) return height;
  height = peak;
  for (std::size_t i = 0; i < grain_count(state); ++i)
    height = std::min(height, state.particles.position.z[i] - state.particles.radius[i]);
  return height;
}

/// See flank.hpp; rings are one mean diameter wide.
double slope_of_bed(const State& state, bool slot) {
  const Particles& p = state.particles;
  std::vector<Ball> grains;
  for (std::size_t i = 0; i < grain_count(state); ++i) grains.push_back({p.position.get(i), p.radius[i]});
  const std::vector<Eigen::Vector2d> surface = mean_surface(grains, state.mean_diameter, slot);
  const double peak = peak_height(surface);
  return std::isfinite(peak) ? angle_of_repose(surface, ground(state, peak), state.mean_diameter) : not_known;
}

[[noreturn]] void throw_at_line(const std::string& path, std::size_t line, const std::string& what) {
  throw FileError(path + ":" + std::to_string(line) + ": error: " + what);
}

/// "name [unit]" taken apart.
BedQuantity quantity_of_heading(const std::string& heading) {
  const std::size_t bracket = heading.rfind(" [");
  if (bracket == std::string::npos || heading.back() != ']') return {heading, "", 0};
  return {heading.substr(0, bracket), heading.substr(bracket + 2, heading.size() - bracket - 3), 0};
}

}  // namespace

StageResult measure_bed(const State& state, const Scene& scene, const std::string& stage, double discharge_rate,
                        double wall_seconds) {
  const double copies = std::max(scene.domain.order, state.symmetry.order());  // also where the sides are solid
  const bool slot = scene.domain.kind == DomainKind::slot;
  const double count = state.particles.count();
  StageResult result{stage, {}};
  const auto add = [&](const std::string& name, const char* unit, double value) {
    result.quantities.push_back({name, unit, value});
  };
  add("time", "s", state.time);
  add("grains", "", count * copies);
  add("grains discharged", "", static_cast<double>(state.taken_out) * copies);
  add("packing fraction", "", packing_fraction(state, scene));
  add("coordination number", "", coordination_number(state, scene));
  const std::vector<WallLoad> loads = wall_loads(state);
  for (int w = 0; w < state.vessel.wall_count(); ++w)
    add("load on " + state.vessel.wall(w).name, "N", 0 - loads[static_cast<std::size_t>(w)].force.z * copies);
  double mass = 0;
  for (std::size_t i = 0; i < grain_count(state); ++i) mass += state.particles.mass[i];
  add("weight of all grains", "N", mass * std::abs(scene.domain.gravity.z()) * copies);
  add("kinetic energy per grain", "J", count > 0 ? mean_kinetic_energy(state) : not_known);
  add("bed height", "m", bed_height(state, scene));
  add("discharge rate", "1/s", discharge_rate * copies);
  add("angle of repose", "deg", slope_of_bed(state, slot));
  add("wall time", "s", wall_seconds);
  return result;
}

void write_bed_table(const std::string& path, const std::vector<StageResult>& stages) {
  std::string text = "stage";
  if (!stages.empty()) {
    for (const BedQuantity& q : stages.front().quantities)
      text += "," + csv_quoted(q.unit.empty() ? q.name : q.name + " [" + q.unit + "]");
  }
  text += '\n';
  for (const StageResult& stage : stages) {
    require(stage.quantities.size() == stages.front().quantities.size(), "stages measured in different quantities");
    text += csv_quoted(stage.stage);
    for (std::size_t k = 0; k < stage.quantities.size(); ++k) {
      require(stage.quantities[k].name == stages.front().quantities[k].name,
              "stages measured in different quantities");
      text += ',';
      append_number(text, stage.quantities[k].value);
    }
    text += '\n';
  }
  write_text_file_atomically(path, text);
}

std::vector<StageResult> read_bed_table(const std::string& path) {
  const std::string text = read_text_file(path);
  std::vector<StageResult> stages;
  std::vector<BedQuantity> columns;
  std::size_t begin = 0;
  for (std::size_t line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::vector<CsvField> fields = split_csv_line(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (line == 1) {
      if (fields.empty() || fields[0].text != "stage") throw_at_line(path, line, "this is not a table of beds");
      for (std::size_t k = 1; k < fields.size(); ++k) columns.push_back(quantity_of_heading(fields[k].text));
      continue;
    }
    if (fields.size() != columns.size() + 1)
      throw_at_line(path, line, "expected " + std::to_string(columns.size() + 1) + " fields");
    StageResult stage{fields[0].text, columns};
    for (std::size_t k = 0; k < columns.size(); ++k) {
      if (parse_number(fields[k + 1].text, stage.quantities[k].value) != NumberError::none)
        throw_at_line(path, line, "'" + fields[k + 1].text + "' is not a number");
    }
    stages.push_back(std::move(stage));
  }
  if (columns.empty() && stages.empty() && text.empty()) throw FileError(path + ": the table of beds is empty");
  return stages;
}

}  // namespace wedge
