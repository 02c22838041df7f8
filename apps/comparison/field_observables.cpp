// field_observables.cpp: rows of radial.csv and map.csv of many runs brought to the same cells.
#include "apps/comparison/field_observables.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/comparison/gathered.hpp"

namespace wedge {
namespace {

/// Different values of a coordinate, in order: those nearer than `same` to their neighbour count as one.
class Levels {
public:
  Levels(std::vector<double> values, double same) {
    std::sort(values.begin(), values.end());
    for (std::size_t k = 0; k < values.size(); ++k)
      if (k == 0 || values[k] - values[k - 1] > same) starts_.push_back(values[k]);
  }
  std::size_t of(double value) const {
    return static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), value) - starts_.begin()) - 1;
  }

private:
  std::vector<double> starts_;  // least value of each level
};

/// The cells of a moment: each row of each table has a place among them.
class Cells {
public:
  /// `same` [m]: coordinates nearer than that are the same; runs whose mean diameters differ a little have them.
  Cells(const std::vector<const FieldResult*>& tables, double same)
      : r_(all(tables, &FieldResult::r), same), z_(all(tables, &FieldResult::z), same) {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
    for (const FieldResult* table : tables) {
      std::vector<std::size_t>& cells = cells_[table];
      for (std::size_t row = 0; row < table->r.size(); ++row) {
        const auto key = std::make_pair(r_.of(table->r[row]), table->z.empty() ? 0 : z_.of(table->z[row]));
        const auto place = places.try_emplace(key, distance_.size());
        if (place.second) distance_.push_back(table->r[row]);
        cells.push_back(place.first->second);
      }
    }
  }
  /// Distance of each cell from the axis [m].
  const std::vector<double>& distances() const { return distance_; }
  /// Of each row.
  const std::vector<std::size_t>& of(const FieldResult* table) const { return cells_.at(table); }

private:
  static std::vector<double> all(const std::vector<const FieldResult*>& tables,
                                 std::vector<double> FieldResult::*coordinate) {
    std::vector<double> values;
    for (const FieldResult* table : tables)
      values.insert(values.end(), (table->*coordinate).begin(), (table->*coordinate).end());
    return values;
  }

  Levels r_, z_;
  std::vector<double> distance_;
  std::map<const FieldResult*, std::vector<std::size_t>> cells_;
};

constexpr std::size_t outside = static_cast<std::size_t>(-1);

/// Where the cells of a region stand in its samples; `outside` for cells of others.
struct CellsOfRegion {
  RegionKind kind;
  std::vector<std::size_t> places;
  Eigen::Index size = 0;
};

template <class Inside>
CellsOfRegion cells_of(RegionKind kind, const std::vector<double>& distances, Inside inside) {
  CellsOfRegion region{kind, {}, 0};
  for (const double r : distances)
    region.places.push_back(inside(r) ? static_cast<std::size_t>(region.size++) : outside);
  return region;
}

const FieldColumn* column_of(const FieldResult& table, const std::string& quantity) {
  for (const FieldColumn& column : table.columns)
    if (column.quantity == quantity) return &column;
  return nullptr;
}

Sample field_sample(const FieldResult& table, const FieldColumn& column, const std::vector<std::size_t>& cells,
                    const CellsOfRegion& region) {
  Sample sample{Eigen::ArrayXd::Zero(region.size), Eigen::ArrayXd::Zero(region.size)};
  for (std::size_t row = 0; row < cells.size(); ++row) {
    const std::size_t place = region.places[cells[row]];
    const double weight = table.weight[row], value = column.values[row];
    if (place == outside || !(weight > 0) || !std::isfinite(weight) || !std::isfinite(value)) continue;
    sample.amount[static_cast<Eigen::Index>(place)] += weight;
    sample.content[static_cast<Eigen::Index>(place)] += weight * value;
  }
  return sample;
}

}  // namespace

std::vector<Observable> field_observables(const RunSets& sets, const std::string& moment, Kind kind,
                                          const std::vector<const ResultQuantity*>& wanted) {
  std::vector<const FieldResult*> tables;
  const auto gathered = gather<FieldResult>(sets, [&](const RunResults& run, const std::string& part) {
    const Fields& fields = kind == Kind::map ? run.cells : run.rings;
    const auto found = fields.find({moment, part});
    if (found == fields.end()) return static_cast<const FieldResult*>(nullptr);
    tables.push_back(&found->second);
    return &found->second;
  });
  if (gathered.compared.empty()) return {};
  const Cells cells(tables, 0.05 * sets.compared[0].diameter);
  std::vector<CellsOfRegion> regions{cells_of(RegionKind::all, cells.distances(), [](double) { return true; })};
  if (const double edge = axis_zone_radius(sets); edge > 0) {
    regions.push_back(cells_of(RegionKind::axis_zone, cells.distances(), [&](double r) { return r < edge; }));
    regions.push_back(cells_of(RegionKind::rest, cells.distances(), [&](double r) { return r >= edge; }));
  }
  std::vector<Observable> all;
  for (const ResultQuantity* q : wanted) {
    const bool everywhere = std::all_of(tables.begin(), tables.end(), [&](const FieldResult* table) {
      return column_of(*table, q->name) != nullptr;
    });
    for (const CellsOfRegion& region : regions) {
      if (!everywhere || region.size == 0) continue;
      Observable o;
      o.kind = kind;
      o.region = name_of(region.kind);
      o.quantity = q->name;
      put_samples(
          gathered,
          [&](const FieldResult* table) {
            return field_sample(*table, *column_of(*table, q->name), cells.of(table), region);
          },
          o);
      all.push_back(std::move(o));
    }
  }
  return all;
}

}  // namespace wedge
