// moment_sums.cpp: adds frames up, part by part.
#include "apps/analysis/moment_sums.hpp"

#include <algorithm>
#include <cmath>

#include "apps/measure/flank.hpp"
#include "core/time_scales.hpp"

namespace wedge {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr int rattles_below = 2;         // contacts
constexpr double scatter_angle = 30;     // degrees of azimuth, for the scatter of the angle of repose
constexpr double filled_packing = 0.45;  // less: the bed does not fill the vessel

double volume_of(const BedGrain& g) { return 4 * numbers::pi / 3 * g.radius * g.radius * g.radius; }

/// Values of a grain for the distributions, in their order; nan where it has none.
std::vector<double> values_of(const BedGrain& g, bool forces) {
  const auto without = [](int cn) { return cn >= rattles_below ? cn : not_known; };
  return {static_cast<double>(g.cn),
          static_cast<double>(g.cn_near),
          static_cast<double>(g.cn_distinct),
          without(g.cn),
          without(g.cn_near),
          g.velocity.x,
          g.velocity.y,
          g.velocity.z,
          forces ? g.normal_force.x : not_known,
          forces ? g.normal_force.y : not_known,
          forces ? g.normal_force.z : not_known};
}
constexpr std::size_t load_kind = 11;

}  // namespace

std::vector<DistributionKind> distribution_kinds(const AnalysedRun& run, double mean_mass) {
  const Bins whole{};
  const double g = run.gravity() > 0 ? run.gravity() : 9.81;
  const Bins speed{0.01 * std::sqrt(g * run.diameter), 0.1}, force{mean_mass * g, 0.1};
  return {{"cn", "", whole},
          {"cn_near", "", whole},
          {"cn_distinct", "", whole},
          {"cn_without_rattlers", "", whole},
          {"cn_near_without_rattlers", "", whole},
          {"vr", "m/s", speed},
          {"vt", "m/s", speed},
          {"vz", "m/s", speed},
          {"fr", "N", force},
          {"ft", "N", force},
          {"fz", "N", force},
          {"load", "N", force}};
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

PartSums::PartSums(const AnalysedRun& run, const Part& part, const FieldGrid& grid, double mean_mass)
    : run_(run), part_(part), grid_(grid), kinds_(distribution_kinds(run, mean_mass)) {
  histograms_.resize(part_.regions.size() * kinds_.size());
  rings_.resize(static_cast<std::size_t>(std::ceil(run_.radius / ring_width())) + 1);
  const std::size_t cells = static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows);
  fields_.assign(cells * grain_fields, 0);
  stresses_.assign(cells * stress_fields, 0);
}

const Histogram& PartSums::histogram(std::size_t region, std::size_t kind) const {
  return histograms_[region * kinds_.size() + kind];
}

double PartSums::arc(double r) const { return run_.slot ? not_known : r * part_.angle / run_.diameter; }

void PartSums::add(const BedFrame& bed) {
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

void PartSums::add_distributions(const BedFrame& bed) {
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    const std::vector<double> values = values_of(g, bed.has_forces);
    for (std::size_t k = 0; k < values.size(); ++k) count(g.r, k, values[k]);
  }
  if (!bed.has_forces) return;
  for (const BedContact& c : bed.contacts) {
    const BedGrain& g = bed.grains[static_cast<std::size_t>(c.first)];
    if (g.in_bed && part_.holds(g.azimuth)) count(g.r, load_kind, c.load);
  }
}

void PartSums::add_rings(const BedFrame& bed) {
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bulk || !part_.holds(g.azimuth)) continue;
    const auto place = std::min(static_cast<std::size_t>(g.r / ring_width()), rings_.size() - 1);
    Ring& ring = rings_[place];
    ring.grains += 1;
    ring.cn += g.cn;
    ring.cn_near += g.cn_near;
    ring.cn_distinct += g.cn_distinct;
    ring.vr += g.velocity.x;
    ring.vt += g.velocity.y;
    ring.vz += g.velocity.z;
    ring.squares += dot(g.velocity, g.velocity);
    if (run_.slot) continue;
    if (arc(g.r) < core_arc) {
      inner_line_.add(arc(g.r), g.cn);
      distinct_line_.add(arc(g.r), g.cn_distinct);
    } else if (g.r < run_.radius - 2 * run_.diameter) {
      outer_grains_ += 1;
      outer_sum_ += g.cn;
    }
  }
}

void PartSums::add_fields_of(const BedFrame& bed) {
  FieldPoints grains(grain_fields), branches(stress_fields);
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    const Vec3 v = g.velocity;
    const double m = g.mass;
    grains.across.push_back(run_.slot ? g.position.x : g.r);
    grains.up.push_back(g.position.z);
    for (const double value : {1.0, volume_of(g), static_cast<double>(g.cn), static_cast<double>(g.cn_near),
                               static_cast<double>(g.cn_distinct), m, m * v.x, m * v.y, m * v.z, m * v.x * v.x,
                               m * v.y * v.y, m * v.z * v.z, m * v.x * v.z})
      grains.values.push_back(value);
  }
  add_fields(grid_, grains, part_.copies, fields_);
  if (!bed.has_forces) return;
  const double side = 0.5 * std::sqrt(0.6);  // three points of Gauss and Legendre on the branch
  const double places[3] = {0.5 - side, 0.5, 0.5 + side}, weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for (const BedContact& c : bed.contacts) {
    const BedGrain& g = bed.grains[static_cast<std::size_t>(c.first)];
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    // A contact with one's own copy half a turn away is shared by two copies.
    const bool shared = c.first == c.second && 2 * c.turn == run_.symmetry.order();
    const Vec3 branch = c.to - c.from;
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = c.from + places[k] * branch;
      const double r = std::hypot(x.x, x.y), cosine = r > 0 ? x.x / r : 1, sine = r > 0 ? x.y / r : 0;
      const auto turned = [&](Vec3 v) {
        return run_.slot ? v : Vec3{cosine * v.x + sine * v.y, cosine * v.y - sine * v.x, v.z};
      };
      const Vec3 f = turned(c.force), l = turned(branch);
      double rr = -f.x * l.x, tt = -f.y * l.y, rz = -0.5 * (f.x * l.z + f.z * l.x);
      if (!run_.slot && r < 1e-9 * run_.diameter) rr = tt = 0.5 * (rr + tt), rz = 0;  // the axis has no azimuth
      const double share = weights[k] * (shared ? 0.5 : 1);
      branches.across.push_back(run_.slot ? x.x : r);
      branches.up.push_back(x.z);
      for (const double value : {rr, tt, -f.z * l.z, rz}) branches.values.push_back(share * value);
    }
  }
  add_fields(grid_, branches, part_.copies, stresses_);
}

void PartSums::note(const std::string& name, const std::string& unit, double value) {
  auto found = std::find_if(means_.begin(), means_.end(), [&](const Mean& m) { return m.name == name; });
  if (found == means_.end()) found = means_.insert(means_.end(), {name, unit});
  if (!std::isfinite(value)) return;
  found->sum += value;
  found->count += 1;
}

double PartSums::mean(const std::string& scalar) const {
  for (const Mean& m : means_)
    if (m.name == scalar) return m.count > 0 ? m.sum / m.count : not_known;
  return not_known;
}

void PartSums::add_scalars(const BedFrame& bed) {
  add_axis(bed, add_means(bed));
  add_surface(bed);
}

double PartSums::add_means(const BedFrame& bed) {
  double n = 0, cn = 0, near = 0, distinct = 0, rattlers = 0, without = 0, near_without = 0, near_grains = 0;
  double squares = 0;
  Vec3 v{};
  std::vector<std::pair<double, double>> heights;  // height, volume
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    n += 1;
    cn += g.cn;
    near += g.cn_near;
    distinct += g.cn_distinct;
    if (g.cn < rattles_below)
      rattlers += 1;
    else
      without += g.cn;
    if (g.cn_near >= rattles_below) near_grains += 1, near_without += g.cn_near;
    v += g.velocity;
    squares += dot(g.velocity, g.velocity);
    heights.emplace_back(g.position.z, volume_of(g));
  }
  std::sort(heights.begin(), heights.end());
  const auto height = [&](double share) {
    return static_cast<std::size_t>(share * static_cast<double>(heights.size() - 1));
  };
  double packing = not_known, top = not_known;
  if (heights.size() > 1) {
    const std::size_t low = height(0.1), high = height(0.7);
    double volume = 0;
    for (std::size_t k = low; k < high; ++k) volume += heights[k].second;
    packing = volume * part_.copies / (run_.cross_section() * (heights[high].first - heights[low].first));
    top = heights[height(0.95)].first + 0.5 * run_.diameter;
  }
  note("grains", "", n * part_.copies);
  note("packing", "", packing);
  note("bed_height", "m", top);
  note("cn", "", cn / n);
  note("cn_near", "", near / n);
  note("cn_distinct", "", distinct / n);
  note("cn_without_rattlers", "", without / (n - rattlers));
  note("cn_near_without_rattlers", "", near_without / near_grains);
  note("rattlers", "", rattlers / n);
  note("vr", "m/s", v.x / n);
  note("vt", "m/s", v.y / n);
  note("vz", "m/s", v.z / n);
  note("speed", "m/s", std::sqrt(squares / n));
  double load = 0, contacts = 0;
  for (const BedContact& c : bed.contacts) {
    const BedGrain& g = bed.grains[static_cast<std::size_t>(c.first)];
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    load += c.load;
    contacts += 1;
  }
  note("load", "N", bed.has_forces ? load / contacts : not_known);
  return packing;
}

void PartSums::add_axis(const BedFrame& bed, double packing) {
  if (run_.slot) return;
  const double height = bed.bulk_high - bed.bulk_low;
  double bulk_mass = 0, bulk_volume = 0;
  for (const BedGrain& g : bed.grains)
    if (g.in_bulk && part_.holds(g.azimuth)) bulk_mass += g.mass, bulk_volume += volume_of(g);
  for (const int reach : {1, 2}) {
    double mass = 0;
    const double radius = reach * run_.diameter;
    for (const BedGrain& g : bed.grains)
      if (g.in_bulk && part_.holds(g.azimuth) && g.r < radius) mass += g.mass;
    const double line_density = mass * part_.copies / height;
    const double even = bulk_mass / bulk_volume * packing * numbers::pi * radius * radius;
    const std::string ending = std::to_string(reach) + "d";
    note("axis_mass_" + ending, "kg/m", line_density);
    note("axis_density_" + ending, "", packing > filled_packing ? line_density / even : not_known);
  }
}

void PartSums::add_surface(const BedFrame& bed) {
  const double begin = part_.whole ? 0 : part_.begin;
  const int pieces = run_.slot ? 1 : static_cast<int>(std::lround(part_.angle * 180 / numbers::pi / scatter_angle));
  std::vector<Ball> all;
  std::vector<std::vector<Ball>> by_azimuth(static_cast<std::size_t>(std::max(1, pieces)));
  for (const BedGrain& g : bed.grains) {
    if (!g.in_bed || !part_.holds(g.azimuth)) continue;
    all.push_back({g.position, g.radius});
    double turned = g.azimuth - begin;
    if (turned < 0) turned += 2 * numbers::pi;
    const auto piece = static_cast<std::size_t>(turned / part_.angle * static_cast<double>(by_azimuth.size()));
    by_azimuth[std::min(piece, by_azimuth.size() - 1)].push_back(all.back());
  }
  const auto slope = [&](const std::vector<Ball>& grains) {
    return angle_of_repose(mean_surface(grains, run_.diameter, run_.slot), bed.ground, run_.diameter);
  };
  note("angle_of_repose", "deg", slope(all));
  double sum = 0, squares = 0, count = 0;
  for (const auto& piece : by_azimuth) {
    const double angle = slope(piece);
    if (!std::isfinite(angle)) continue;
    sum += angle;
    squares += angle * angle;
    count += 1;
  }
  scatter_parts_ = count;
  scatter_ = count > 1 ? std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1))) : not_known;
  note("angle_of_repose_scatter", "deg", scatter_);
}

double PartSums::outer_cn() const { return outer_grains_ > 0 ? outer_sum_ / outer_grains_ : not_known; }

double PartSums::correction(double r) const {
  const double cn0 = outer_cn(), way = arc(r);
  if (!(way < core_arc)) return 1;
  return cn0 / ((cn0 / 3 - 1) * way + 4 - cn0 / 3);
}

std::vector<Scalar> PartSums::scalars() const {
  std::vector<Scalar> all;
  for (const Mean& m : means_) {
    Estimate e;
    e.value = m.count > 0 ? m.sum / m.count : not_known;
    if (m.name == "angle_of_repose" && scatter_parts_ > 1) {
      e.low = e.value - 1.96 * scatter_ / std::sqrt(scatter_parts_);
      e.high = e.value + 1.96 * scatter_ / std::sqrt(scatter_parts_);
    }
    all.push_back({m.name, m.unit, e});
  }
  const auto add = [&](const char* name, Estimate e) { all.push_back({name, "", e}); };
  const auto plain = [](double value) {
    Estimate e;
    e.value = value;
    return e;
  };
  if (run_.slot) return all;
  const double cn0 = outer_cn();
  add("cn0", plain(cn0));
  if (part_.copies == 1) return all;  // its arcs are those of a whole turn: no core to speak of
  add("core_cn", plain(inner_line_.n > 0 ? inner_line_.y / inner_line_.n : not_known));
  const auto [slope, intercept] = inner_line_.fit(std::max(1, frames_));
  add("cn_slope", slope);
  add("cn_intercept", intercept);
  const auto [distinct_slope, distinct_intercept] = distinct_line_.fit(std::max(1, frames_));
  add("cn_distinct_slope", distinct_slope);
  add("cn_distinct_intercept", distinct_intercept);
  add("cn_slope_paper", plain(cn0 / 3 - 1));
  add("cn_intercept_paper", plain(4 - cn0 / 3));
  return all;
}

}  // namespace wedge
