// bed_numbers.cpp: sums over the grains of a part of the bed, and the slope of its surface.
#include "apps/measure/bed_numbers.hpp"

#include <algorithm>
#include <cmath>

#include "apps/measure/flank.hpp"
#include "core/time_scales.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr double scatter_angle = 30;     // degrees of azimuth, for the scatter of the angle of repose
constexpr double filled_packing = 0.45;  // less: the bed does not fill the vessel

/// Numbers of one part as they are found.
class Numbers {
public:
  Numbers(const MeasuredDomain& domain, const Bed& bed, const Part& part)
      : domain_(domain), bed_(bed), part_(part) {
    for (const BedGrain& g : bed.grains)
      if (g.in_bed && part.holds(g.azimuth)) grains_.push_back(&g);
  }

  std::vector<Scalar> all() {
    add_heights();
    add_means();
    add_load();
    if (!domain_.slot) add_axis();
    add_slope();
    return std::move(found_);
  }

private:
  void add(const char* name, double value) { found_.push_back(scalar(name, value)); }

  /// Of the whole vessel.
  double in_vessel(const BedGrain& g) const { return g.weight * part_.pieces; }

  void add_heights() {
    std::vector<std::pair<double, double>> heights;  // height, volume in the vessel
    double n = 0, top = not_known;
    for (const BedGrain* g : grains_) {
      n += in_vessel(*g);
      heights.emplace_back(g->position.z, volume_of(*g) * in_vessel(*g));
    }
    std::sort(heights.begin(), heights.end());
    const auto place = [&](double share) {
      return static_cast<std::size_t>(share * static_cast<double>(heights.size() - 1));
    };
    if (heights.size() > 1) {
      const std::size_t low = place(0.1), high = place(0.7);
      double volume = 0;
      for (std::size_t k = low; k < high; ++k) volume += heights[k].second;
      packing_ = volume / (domain_.cross_section() * (heights[high].first - heights[low].first));
      top = heights[place(0.95)].first + 0.5 * domain_.diameter;
    }
    add("grains", n);
    add("packing", packing_);
    add("bed_height", top);
  }

  void add_means() {
    double n = 0, cn = 0, near = 0, distinct = 0, rattlers = 0, without = 0, near_grains = 0, near_without = 0;
    double squares = 0;
    Vec3 v{};
    for (const BedGrain* g : grains_) {
      const double w = g->weight;
      n += w;
      cn += w * g->cn;
      near += w * g->cn_near;
      distinct += w * g->cn_distinct;
      (g->cn < rattles_below ? rattlers : without) += g->cn < rattles_below ? w : w * g->cn;
      if (g->cn_near >= rattles_below) near_grains += w, near_without += w * g->cn_near;
      v += w * g->velocity;
      squares += w * dot(g->velocity, g->velocity);
    }
    add("cn", cn / n);
    add("cn_near", bed_.has_near ? near / n : not_known);
    add("cn_distinct", distinct / n);
    add("cn_without_rattlers", without / (n - rattlers));
    add("cn_near_without_rattlers", bed_.has_near ? near_without / near_grains : not_known);
    add("rattlers", rattlers / n);
    add("vr", v.x / n);
    add("vt", v.y / n);
    add("vz", v.z / n);
    add("speed", std::sqrt(squares / n));
  }

  void add_load() {
    double load = 0, contacts = 0;
    for (const BedContact& c : bed_.contacts) {
      const BedGrain& g = bed_.grains[static_cast<std::size_t>(c.first)];
      if (!g.in_bed || !part_.holds(g.azimuth)) continue;
      load += g.weight * c.load;
      contacts += g.weight;
    }
    add("load", bed_.has_forces ? load / contacts : not_known);
  }

  void add_axis() {
    const double height = bed_.bulk_high - bed_.bulk_low;
    double bulk_mass = 0, bulk_volume = 0;
    for (const BedGrain& g : bed_.grains) {
      if (!g.in_bulk || !part_.holds(g.azimuth)) continue;
      bulk_mass += g.weight * g.mass;
      bulk_volume += g.weight * volume_of(g);
    }
    for (const int reach : {1, 2}) {
      double mass = 0;
      const double radius = reach * domain_.diameter;
      for (const BedGrain& g : bed_.grains)
        if (g.in_bulk && part_.holds(g.azimuth) && g.r < radius) mass += in_vessel(g) * g.mass;
      const double line_density = mass / height;
      const double even = bulk_mass / bulk_volume * packing_ * numbers::pi * radius * radius;
      add(reach == 1 ? "axis_mass_1d" : "axis_mass_2d", line_density);
      add(reach == 1 ? "axis_density_1d" : "axis_density_2d",
          packing_ > filled_packing ? line_density / even : not_known);
    }
  }

  /// Slope [deg] of the surface of some of the grains.
  double slope(const std::vector<Ball>& grains) const {
    return angle_of_repose(mean_surface(grains, domain_.diameter, domain_.slot), bed_.ground, domain_.diameter);
  }

  void add_slope() {
    const int pieces =
        domain_.slot ? 1 : static_cast<int>(std::lround(part_.angle * 180 / numbers::pi / scatter_angle));
    std::vector<Ball> all;
    std::vector<std::vector<Ball>> by_azimuth(static_cast<std::size_t>(std::max(1, pieces)));
    for (const BedGrain* g : grains_) {
      all.push_back({g->position, g->radius});
      double turned = g->azimuth - part_.begin;
      if (turned < 0) turned += 2 * numbers::pi;
      const auto piece = static_cast<std::size_t>(turned / part_.angle * static_cast<double>(by_azimuth.size()));
      by_azimuth[std::min(piece, by_azimuth.size() - 1)].push_back(all.back());
    }
    double sum = 0, squares = 0, count = 0;
    for (const auto& piece : by_azimuth) {
      const double angle = slope(piece);
      if (!std::isfinite(angle)) continue;
      sum += angle;
      squares += angle * angle;
      count += 1;
    }
    Estimate of_all = Estimate::of(slope(all));
    const double scatter =
        count > 1 ? std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1))) : not_known;
    of_all.low = of_all.value - 1.96 * scatter / std::sqrt(count);
    of_all.high = of_all.value + 1.96 * scatter / std::sqrt(count);
    found_.push_back(scalar("angle_of_repose", of_all));
    add("angle_of_repose_scatter", scatter);
  }

  const MeasuredDomain& domain_;
  const Bed& bed_;
  const Part& part_;
  std::vector<const BedGrain*> grains_;  // of the part, in the bed
  double packing_ = not_known;
  std::vector<Scalar> found_;
};

}  // namespace

double volume_of(const BedGrain& g) { return 4 * numbers::pi / 3 * g.radius * g.radius * g.radius; }

std::vector<Scalar> bed_numbers(const MeasuredDomain& domain, const Bed& bed, const Part& part) {
  return Numbers(domain, bed, part).all();
}

double value_of(const std::vector<Scalar>& numbers, std::string_view name) {
  for (const Scalar& s : numbers)
    if (s.quantity->name == name) return s.estimate.value;
  return not_known;
}

}  // namespace wedge
