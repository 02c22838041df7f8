// moment_sums.cpp: adds frames up, part by part.
#include "apps/analysis/moment_sums.hpp"

#include <algorithm>
#include <cmath>

#include "apps/measure/bed_numbers.hpp"
#include "core/require.hpp"
#include "core/time_scales.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
double without_rattlers(std::int32_t cn) { return cn >= rattles_below ? cn : not_known; }

/// What a grain adds to a distribution; nan where it has nothing to add.
struct GrainValue {
  const char* name;
  double (*of)(const BedGrain&);
  bool of_forces;
};
constexpr GrainValue grain_values[] = {
    {"cn", [](const BedGrain& g) -> double { return g.cn; }, false},
    {"cn_near", [](const BedGrain& g) -> double { return g.cn_near; }, false},
    {"cn_distinct", [](const BedGrain& g) -> double { return g.cn_distinct; }, false},
    {"cn_without_rattlers", [](const BedGrain& g) { return without_rattlers(g.cn); }, false},
    {"cn_near_without_rattlers", [](const BedGrain& g) { return without_rattlers(g.cn_near); }, false},
    {"vr", [](const BedGrain& g) { return g.velocity.x; }, false},
    {"vt", [](const BedGrain& g) { return g.velocity.y; }, false},
    {"vz", [](const BedGrain& g) { return g.velocity.z; }, false},
    {"fr", [](const BedGrain& g) { return g.normal_force.x; }, true},
    {"ft", [](const BedGrain& g) { return g.normal_force.y; }, true},
    {"fz", [](const BedGrain& g) { return g.normal_force.z; }, true}};

}  // namespace

std::vector<DistributionKind> distribution_kinds(const MeasuredDomain& domain, double mean_mass) {
  const double g = domain.gravity() > 0 ? domain.gravity() : 9.81;
  const Bins whole{}, speed{0.01 * std::sqrt(g * domain.diameter), 0.1}, force{mean_mass * g, 0.1};
  std::vector<DistributionKind> kinds;
  for (const ResultQuantity* q : quantities_in(in_distributions)) {
    const std::string_view unit = q->unit;
    kinds.push_back({q, unit == "m/s" ? speed : unit == "N" ? force : whole});
  }
  return kinds;
}

void LineSums::add(double at, double value) {
  n += 1;
  x += at;
  y += value;
  xx += at * at;
  xy += at * value;
  yy += value * value;
}

std::pair<Estimate, Estimate> LineSums::fit(double repeats) const {
  Estimate slope, intercept;
  const double spread = n * xx - x * x;
  if (n < 3 || !(spread > 0)) return {slope, intercept};
  slope.value = (n * xy - x * y) / spread;
  intercept.value = (y - slope.value * x) / n;
  const double rest =
      std::max(0.0, yy - intercept.value * y - slope.value * xy) / (n - 2);  // variance about the line
  const double slope_error = 1.96 * std::sqrt(rest * n / spread * repeats);
  const double intercept_error = 1.96 * std::sqrt(rest * xx / spread * repeats);
  slope.low = slope.value - slope_error, slope.high = slope.value + slope_error;
  intercept.low = intercept.value - intercept_error, intercept.high = intercept.value + intercept_error;
  return {slope, intercept};
}

PartSums::PartSums(const MeasuredDomain& domain, const Part& part, const FieldGrid& grid, double mean_mass)
    : domain_(domain), part_(part), grid_(grid), kinds_(distribution_kinds(domain, mean_mass)) {
  histograms_.resize(part_.regions.size() * kinds_.size());
  rings_.resize(static_cast<std::size_t>(std::ceil(domain_.radius / ring_width())) + 1);
  const std::size_t cells = static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows);
  fields_.assign(cells * grain_fields, 0);
  stresses_.assign(cells * stress_fields, 0);
}

const Histogram& PartSums::histogram(std::size_t region, std::size_t kind) const {
  return histograms_[region * kinds_.size() + kind];
}

double PartSums::arc(double r) const { return domain_.slot ? not_known : r * part_.angle / domain_.diameter; }

void PartSums::add(const Bed& bed) {
  has_forces_ = has_forces_ && bed.has_forces;
  add_distributions(bed);
  add_rings(bed);
  add_fields_of(bed);
  add_scalars(bed);
  ++frames_;
}

void PartSums::count(double r, std::size_t kind, double value) {
  if (!std::isfinite(value)) return;
  const int bin = kinds_[kind].bins.bin(value);
  for (std::size_t region = 0; region < part_.regions.size(); ++region)
    if (part_.regions[region].holds(r)) histograms_[region * kinds_.size() + kind].add(bin);
}

void PartSums::add_distributions(const Bed& bed) {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const std::string_view name = kinds_[k].quantity->name;
    if (name == "load") continue;  // of contacts, not of grains
    const auto value = std::find_if(std::begin(grain_values), std::end(grain_values),
                                    [&](const GrainValue& v) { return v.name == name; });
    require(value != std::end(grain_values), "a distribution that grains have no value for");
    if (value->of_forces && !bed.has_forces) continue;
    for (const BedGrain& g : bed.grains)
      if (g.in_bed && part_.holds(g.azimuth)) count(g.r, k, value->of(g));
  }
  if (!bed.has_forces) return;
  const auto load = static_cast<std::size_t>(
      std::find_if(kinds_.begin(), kinds_.end(),
                   [](const DistributionKind& kind) { return kind.quantity == &quantity("load"); }) -
      kinds_.begin());
  for (const BedContact& c : bed.contacts) {
    const BedGrain& g = bed.grains[static_cast<std::size_t>(c.first)];
    if (g.in_bed && part_.holds(g.azimuth)) count(g.r, load, c.load);
  }
}

void PartSums::add_rings(const Bed& bed) {
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bulk || !part_.holds(g.azimuth)) continue;
    const auto place = std::min(static_cast<std::size_t>(g.r / ring_width()), rings_.size() - 1);
    Ring& ring = rings_[place];
    const double w = g.weight;
    ring.grains += w;
    ring.cn += w * g.cn;
    ring.cn_near += w * g.cn_near;
    ring.cn_distinct += w * g.cn_distinct;
    ring.vr += w * g.velocity.x;
    ring.vt += w * g.velocity.y;
    ring.vz += w * g.velocity.z;
    ring.squares += w * dot(g.velocity, g.velocity);
    if (domain_.slot) continue;
    if (arc(g.r) < axis_zone_arc) {
      inner_line_.add(arc(g.r), g.cn);
      distinct_line_.add(arc(g.r), g.cn_distinct);
    } else if (g.r < domain_.radius - 2 * domain_.diameter) {
      outer_grains_ += 1;
      outer_sum_ += g.cn;
    }
  }
}

void PartSums::add_fields_of(const Bed& bed) {
  FieldPoints grains(grain_fields), branches(stress_fields);
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    const Vec3 v = g.velocity;
    const double m = g.mass;
    grains.across.push_back(domain_.slot ? g.position.x : g.r);
    grains.up.push_back(g.position.z);
    for (const double value : {1.0, volume_of(g), static_cast<double>(g.cn), static_cast<double>(g.cn_near),
                               static_cast<double>(g.cn_distinct), m, m * v.x, m * v.y, m * v.z, m * v.x * v.x,
                               m * v.y * v.y, m * v.z * v.z, m * v.x * v.z})
      grains.values.push_back(g.weight * value);
  }
  add_fields(grid_, grains, part_.pieces, fields_);
  if (!bed.has_forces) return;
  const double side = 0.5 * std::sqrt(0.6);  // three points of Gauss and Legendre on the branch
  const double places[3] = {0.5 - side, 0.5, 0.5 + side}, weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (const BedContact& c : bed.contacts) {
    const BedGrain& g = bed.grains[static_cast<std::size_t>(c.first)];
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    const bool shared = domain_.symmetry.is_seen_from_both_ends(c.first, c.second, c.turn);
    const Vec3 branch = c.to - c.from;
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = c.from + places[k] * branch;
      const double r = std::hypot(x.x, x.y), cosine = r > 0 ? x.x / r : 1, sine = r > 0 ? x.y / r : 0;
      const auto turned = [&](Vec3 v) {
        return domain_.slot ? v : Vec3{cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
      };
      const Vec3 f = turned(c.force), l = turned(branch);
      double rr = -f.x * l.x, tt = -f.y * l.y, rz = -0.5 * (f.x * l.z + f.z * l.x);
      if (!domain_.slot && r < 1e-9 * domain_.diameter)
        rr = tt = 0.5 * (rr + tt), rz = 0;  // the axis has no azimuth
      const double share = g.weight * weights[k] * (shared ? 0.5 : 1);
      branches.across.push_back(domain_.slot ? x.x : r);
      branches.up.push_back(x.z);
      for (const double value : {rr, tt, -f.z * l.z, rz}) branches.values.push_back(share * value);
    }
  }
  add_fields(grid_, branches, part_.pieces, stresses_);
}

double PartSums::mean(std::string_view scalar) const {
  for (const Mean& m : means_)
    if (m.last.quantity->name == scalar) return m.count > 0 ? m.sum / m.count : not_known;
  return not_known;
}

void PartSums::add_scalars(const Bed& bed) {
  const std::vector<Scalar> numbers = bed_numbers(domain_, bed, part_);
  means_.resize(numbers.size(), {numbers.front()});
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    means_[k].last = numbers[k];
    if (!std::isfinite(numbers[k].estimate.value)) continue;
    means_[k].sum += numbers[k].estimate.value;
    means_[k].count += 1;
  }
}

double PartSums::outer_cn() const { return outer_grains_ > 0 ? outer_sum_ / outer_grains_ : not_known; }

double PartSums::correction(double r) const {
  const double cn0 = outer_cn(), way = arc(r);
  if (!(way < axis_zone_arc)) return 1;
  return cn0 / ((cn0 / 3 - 1) * way + 4 - cn0 / 3);
}

std::vector<Scalar> PartSums::scalars() const {
  std::vector<Scalar> all;
  for (const Mean& m : means_) {
    const Estimate& last = m.last.estimate;
    Estimate e = Estimate::of(m.count > 0 ? m.sum / m.count : not_known);
    e.low = e.value - (last.value - last.low);
    e.high = e.value + (last.high - last.value);
    all.push_back({m.last.quantity, e});
  }
  if (domain_.slot) return all;
  const double cn0 = outer_cn();
  all.push_back(scalar("cn0", cn0));
  if (part_.angle == 2 * numbers::pi) return all;  // its arcs are those of a whole turn: no axis zone to speak of
  all.push_back(scalar("axis_zone_cn", inner_line_.n > 0 ? inner_line_.y / inner_line_.n : not_known));
  const auto [slope, intercept] = inner_line_.fit(std::max(1, frames_));
  all.push_back(scalar("cn_slope", slope));
  all.push_back(scalar("cn_intercept", intercept));
  const auto [distinct_slope, distinct_intercept] = distinct_line_.fit(std::max(1, frames_));
  all.push_back(scalar("cn_distinct_slope", distinct_slope));
  all.push_back(scalar("cn_distinct_intercept", distinct_intercept));
  all.push_back(scalar("cn_slope_paper", cn0 / 3 - 1));
  all.push_back(scalar("cn_intercept_paper", 4 - cn0 / 3));
  return all;
}

}  // namespace wedge
