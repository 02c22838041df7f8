// vocabulary.cpp: the table of quantities, and the names of regions, parts and moments.
#include "apps/results/vocabulary.hpp"

#include <cmath>

#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

using K = QuantityKind;
constexpr bool overview = true, detail = false;
constexpr unsigned fields = in_profile | in_map;

/// One line a quantity where it fits. To add one: a line here, and the place that measures it.
const std::vector<ResultQuantity> all_quantities = {
    {"time", "s", K::coordinate, in_beds | in_flow, "time",
     "Simulated time; in flow.csv since the first stage that took a wall away began.", detail},
    {"grains", "", K::extensive, in_scalars | fields | in_beds, "grains in the bed",
     "Grains of the bed; in profiles and maps those of the ring or cell, which are its weight in comparisons.",
     detail},
    {"grains_discharged", "", K::extensive, in_beds, "grains discharged",
     "Grains that have left through the outlet since the start.", detail},
    {"packing", "", K::mean, in_scalars | in_map | in_beds, "packing fraction",
     "Volume of grains over volume of the vessel at its widest, between the 10 and 70 % quantiles of height; says "
     "little of a pile. In the map the sum of V_i W: within about 2 d of walls and of the surface the kernel W "
     "reaches "
     "outside.",
     overview},
    {"bed_height", "m", K::mean, in_scalars | in_beds, "bed height", "95 % quantile of z plus d/2.", overview},
    {"cn", "", K::mean, in_scalars | in_distributions | fields | in_beds | in_pictures, "coordination number",
     "Contacts of a grain with other grains, overlap > 0; walls do not count. A contact through the seam counts "
     "for "
     "the grains on both sides; one with the grain's own copy half a turn away once, with another copy twice.",
     overview},
    {"cn_near", "", K::mean, in_scalars | in_distributions | fields, "near neighbours",
     "Neighbours of a grain across a gap (distance less radii) below 0.005 d, each image by itself; walls do not "
     "count.",
     overview},
    {"cn_distinct", "", K::mean, in_scalars | in_distributions | fields, "distinct neighbours",
     "As cn, but a neighbour that touches more than once (directly and through the seam) counts once.", overview},
    {"cn_corrected", "", K::mean, fields, "corrected coordination number",
     "cn_distinct CN0 / (k r theta / d + b) at arcs below 4 d, with k = CN0/3 - 1 and b = 4 - CN0/3 (Yang et al. "
     "2014); else cn_distinct.",
     detail},
    {"cn_without_rattlers", "", K::mean, in_scalars | in_distributions, "mechanical coordination number",
     "Mean cn of grains with at least two contacts (Thornton, Geotechnique 50, 2000).", overview},
    {"cn_near_without_rattlers", "", K::mean, in_scalars | in_distributions, "near neighbours without rattlers",
     "Mean cn_near of grains with at least two near neighbours.", detail},
    {"rattlers", "", K::share, in_scalars, "share of rattlers",
     "Share of the grains with fewer than two contacts, which carry nothing.", overview},
    {"cn0", "", K::mean, in_scalars, "CN0, far from the axis",
     "Mean cn of bulk grains at arcs of 4 d and more, those within 2 d of the widest wall left out.", detail},
    {"axis_zone_cn", "", K::mean, in_scalars, "coordination number in the axis zone",
     "Mean cn of bulk grains in the axis zone; of sectors and wedges.", overview},
    {"cn_slope", "", K::fit, in_scalars, "slope k of CN against arc",
     "k of CN = k r theta / d + b, least squares over bulk grains of the axis zone; interval: 1.96 standard "
     "errors. "
     "Of sectors and wedges.",
     overview},
    {"cn_intercept", "", K::fit, in_scalars, "intercept b of CN against arc", "b of the same line.", detail},
    {"cn_distinct_slope", "", K::fit, in_scalars, "slope k of distinct neighbours", "As cn_slope, of cn_distinct.",
     overview},
    {"cn_distinct_intercept", "", K::fit, in_scalars, "intercept b of distinct neighbours",
     "As cn_intercept, of cn_distinct.", detail},
    {"cn_slope_paper", "", K::expected, in_scalars, "slope k, the paper's", "CN0/3 - 1 (Yang et al. 2014).",
     detail},
    {"cn_intercept_paper", "", K::expected, in_scalars, "intercept b, the paper's", "4 - CN0/3 (Yang et al. 2014).",
     detail},
    {"vr", "m/s", K::mean, in_scalars | in_distributions | fields | in_pictures, "radial velocity",
     "Velocity along the radius, outwards; in a slot along x. On the axis 0.", overview},
    {"vt", "m/s", K::mean, in_scalars | in_distributions | fields, "azimuthal velocity",
     "Velocity along the azimuth, counter-clockwise; in a slot along y. On the axis 0.", overview},
    {"vz", "m/s", K::mean, in_scalars | in_distributions | fields | in_pictures, "vertical velocity",
     "Velocity upwards.", overview},
    {"speed", "m/s", K::mean, in_scalars, "root mean square speed", "Root mean square of the velocity.", overview},
    {"speed_spread", "m/s", K::mean, in_profile, "velocity fluctuation",
     "Root mean square of the velocity less its mean in the ring.", overview},
    {"fr", "N", K::mean, in_distributions, "radial normal force on a grain",
     "Sum of the normal forces of other grains on a grain, along the radius; walls do not count. In a slot along "
     "x.",
     overview},
    {"ft", "N", K::mean, in_distributions, "azimuthal normal force on a grain",
     "The same along the azimuth; in a slot along y.", overview},
    {"fz", "N", K::mean, in_distributions, "vertical normal force on a grain", "The same upwards.", overview},
    {"load", "N", K::mean, in_scalars | in_distributions | in_pictures, "contact force",
     "Normal force of a contact between grains, positive when they push; it belongs to the region and part of its "
     "first grain.",
     overview},
    {"prr", "Pa", K::mean, in_map, "radial pressure",
     "Component rr of the pressure tensor, positive when pressed: sum over contacts of -f_a l_b times the mean of "
     "W "
     "along the branch l from centre to centre (Goldhirsch, Granular Matter 12, 2010), f the whole contact force "
     "on "
     "the first grain, plus sum of m_i v'_a v'_b W with v' = v_i - v(r, z). Contacts with walls do not count.",
     overview},
    {"ptt", "Pa", K::mean, in_map, "azimuthal pressure", "Component tt of the same.", detail},
    {"pzz", "Pa", K::mean, in_map, "vertical pressure", "Component zz of the same.", overview},
    {"prz", "Pa", K::mean, in_map, "shear stress", "Component rz of the same.", detail},
    {"axis_mass_1d", "kg/m", K::per_height, in_scalars, "mass within d of the axis",
     "Mass of bulk grains whose centres lie within d of the axis, over the height of the bulk.", detail},
    {"axis_density_1d", "", K::mean, in_scalars, "mass within d of the axis, over the bulk's",
     "axis_mass_1d over what packing puts there: 1 where the axis is like the rest; nan where packing is below "
     "0.45, "
     "as in a pile.",
     overview},
    {"axis_mass_2d", "kg/m", K::per_height, in_scalars, "mass within 2 d of the axis",
     "Mass of bulk grains whose centres lie within 2 d of the axis, over the height of the bulk.", detail},
    {"axis_density_2d", "", K::mean, in_scalars, "mass within 2 d of the axis, over the bulk's",
     "axis_mass_2d over what packing puts there.", overview},
    {"discharge_rate", "1/s", K::extensive, in_scalars | in_beds, "discharge rate",
     "Grains of the whole vessel that crossed the outlet in a span of time over its length, start-up included: the "
     "mean moment's span from the opening on; in beds.csv the stage. Interval by bootstrap over 16 blocks of time.",
     overview},
    {"arched", "", K::share, in_scalars, "arched",
     "Of a vessel with an orifice: 1 when no grain crossed in the last 0.2 s (or the last half of a span shorter "
     "than "
     "0.4 s), else 0.",
     detail},
    {"beverloo_low", "1/s", K::expected, in_scalars, "Beverloo's law, low",
     "C packing sqrt(g) (D0 - k d)^(5/2) over the volume of a grain, with C 0.55, k 1.5 and the packing at the end "
     "of "
     "the stage before the opening (Beverloo et al. 1961); nan without an orifice.",
     detail},
    {"beverloo_high", "1/s", K::expected, in_scalars, "Beverloo's law, high", "The same with C 0.64, k 1.4.",
     detail},
    {"zone_stagnant", "m3", K::extensive, in_scalars, "stagnant volume",
     "Volume of the cells of the map in zone 1; the lowest corner at the wall, where the kernel reaches outside, "
     "is "
     "left out.",
     detail},
    {"zone_plug", "m3", K::extensive, in_scalars, "volume of plug flow", "Volume of the cells in zone 2.", detail},
    {"zone_converging", "m3", K::extensive, in_scalars, "volume of converging flow",
     "Volume of the cells in zone 3.", detail},
    {"angle_of_repose", "deg", K::fit, in_scalars | in_beds, "angle of repose",
     "Slope of the mean surface (highest grain of each cell about d wide, ring by ring of d) outside its peak, "
     "between "
     "10 and 90 % of its height, up to the first ring that is missing or more than d higher than the one inside "
     "it: "
     "least squares; interval from the scatter over azimuth.",
     overview},
    {"angle_of_repose_scatter", "deg", K::fit, in_scalars, "scatter of the angle of repose",
     "Standard deviation of the same fit in parts of 30 degrees of azimuth; nan of a sector below 60 degrees, "
     "which "
     "has one part.",
     detail},
    {"weight_of_grains", "N", K::extensive, in_beds, "weight of all grains",
     "Mass times gravity of all grains, whether in the bed or not.", detail},
    {"wall_load", "N", K::extensive, in_beds, "load on a wall",
     "Downward force of the grains on a wall, in the column `load on WALL`.", detail},
    {"kinetic_energy_per_grain", "J", K::mean, in_beds, "kinetic energy per grain",
     "Kinetic energy, rotation left out, over the number of grains.", detail},
    {"wall_time", "s", K::label, in_beds, "wall time", "What the stage took on this machine.", detail},
    {"out", "", K::extensive, in_flow, "grains out", "Grains that have crossed the outlet since the opening.",
     detail},
    {"rate", "1/s", K::extensive, in_flow, "rate", "Grains that crossed since the row before, over 0.05 s.",
     detail},
    {"r", "m", K::coordinate, fields, "distance from the axis",
     "Middle of the ring or cell; in the map of a slot x.", detail},
    {"arc", "d", K::coordinate, in_profile, "arc", "r theta / d; nan in a slot.", detail},
    {"z", "m", K::coordinate, in_map | in_pictures, "height", "Middle of the cell; of a grain its centre.", detail},
    {"zone", "", K::label, in_map, "flow zone",
     "Of a flow with a discharge: 1 stagnant (-vz < 0.1 v0), 2 plug (0.5 v0 <= -vz <= 1.5 v0 and abs(vr) <= 0.1 "
     "abs(vz)), 3 converging (the rest); 0: no bed (packing below 0.3) or no discharge. v0: discharge_rate times "
     "the "
     "volume of a mean grain over (packing times cross section), the speed of a plug as wide as the vessel.",
     detail},
    {"x", "m", K::coordinate, in_pictures, "x", "Of a slice along its half plane, from the axis outwards.", detail},
    {"y", "m", K::coordinate, in_pictures, "y", "Of a slice off its plane.", detail},
    {"x1", "m", K::coordinate, in_pictures, "x of the first grain", "End of a line of a network.", detail},
    {"z1", "m", K::coordinate, in_pictures, "z of the first grain", "End of a line of a network.", detail},
    {"x2", "m", K::coordinate, in_pictures, "x of the second grain", "End of a line of a network.", detail},
    {"z2", "m", K::coordinate, in_pictures, "z of the second grain", "End of a line of a network.", detail},
    {"radius", "m", K::coordinate, in_pictures, "radius", "Of the grain.", detail},
    {"layer", "", K::label, in_pictures, "layer", "Of the grain's height at the start, for colours.", detail},
};

/// The whole number that a text is, from 2 on; nothing for anything else.
std::optional<int> whole_number(std::string_view text, int least) {
  int value = 0;
  const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
  if (!digits || (text.size() > 1 && text[0] == '0') || parse_number(text, value) != NumberError::none ||
      value < least)
    return std::nullopt;
  return value;
}

/// What follows a beginning; nothing when the text begins otherwise.
std::optional<std::string_view> after(std::string_view text, std::string_view beginning) {
  if (text.substr(0, beginning.size()) != beginning) return std::nullopt;
  return text.substr(beginning.size());
}

}  // namespace

const std::vector<ResultQuantity>& quantities() { return all_quantities; }

std::vector<const ResultQuantity*> quantities_in(ResultTable table) {
  std::vector<const ResultQuantity*> found;
  for (const ResultQuantity& q : all_quantities)
    if (q.is_in(table)) found.push_back(&q);
  return found;
}

const ResultQuantity* find_quantity(std::string_view name) {
  for (const ResultQuantity& q : all_quantities)
    if (q.name == name) return &q;
  return nullptr;
}

const ResultQuantity& quantity(std::string_view name) {
  const ResultQuantity* found = find_quantity(name);
  require(found != nullptr, "a quantity that the vocabulary does not name");
  return *found;
}

std::string heading(std::string_view name) {
  const ResultQuantity& q = quantity(name);
  return *q.unit == '\0' ? std::string(q.name) : std::string(q.name) + " [" + q.unit + "]";
}

std::string headings(const std::vector<const char*>& names) {
  std::string text;
  for (const char* name : names) text += "," + heading(name);
  return text;
}

std::string wall_load_name(const std::string& wall) { return "load on " + wall; }

double axis_zone_edge(int sectors, double diameter) {
  return axis_zone_arc * diameter * sectors / (2 * numbers::pi);
}

std::string angle_text(int sectors) { return number_text(std::round(360e6 / sectors) / 1e6); }

std::string angle_label(int sectors) { return number_text(std::round(3600.0 / sectors) / 10) + "\u00b0"; }

std::optional<int> sectors_of(const std::string& degrees) {
  double angle = 0;
  if (parse_number(degrees, angle) != NumberError::none || !(angle >= 1 && angle <= 180)) return std::nullopt;
  const double sectors = std::round(360 / angle);
  const std::size_t point = degrees.find('.');
  const double decimals = point == std::string::npos ? 0 : static_cast<double>(degrees.size() - point - 1);
  const double rounding = 0.5 * std::pow(10, -decimals), off = std::abs(angle - 360 / sectors);
  // A few thousandths of it apart are the angles of neighbouring numbers of sectors.
  if (off > 1e-9 * angle && (off > rounding * (1 + 1e-9) || off > 1e-3 * angle)) return std::nullopt;
  return static_cast<int>(sectors);
}

const char* name_of(RegionKind kind) {
  const char* const names[] = {"all", "axis_zone", "rest"};
  return names[static_cast<int>(kind)];
}

const char* label_of(RegionKind kind) {
  const char* const labels[] = {"all", "axis zone", "rest"};
  return labels[static_cast<int>(kind)];
}

std::string name_of(RegionId region) {
  if (region.kind == RegionKind::all) return name_of(region.kind);
  return std::string(name_of(region.kind)) + "_n" + std::to_string(region.sectors);
}

std::string label_of(RegionId region) {
  if (region.kind == RegionKind::all) return label_of(region.kind);
  return (region.kind == RegionKind::rest ? "outside the axis zone of " : "axis zone of ") +
         angle_label(region.sectors);
}

std::optional<RegionId> region_of(std::string_view name) {
  if (name == name_of(RegionKind::all)) return RegionId{};
  for (const RegionKind kind : {RegionKind::axis_zone, RegionKind::rest})
    if (const auto rest = after(name, std::string(name_of(kind)) + "_n"))
      if (const auto sectors = whole_number(*rest, 2)) return RegionId{kind, *sectors};
  return std::nullopt;
}

std::string name_of(PartId part) {
  if (part.whole()) return "whole";
  return "wedge_n" + std::to_string(part.sectors) + "_" + std::to_string(part.number);
}

std::string label_of(PartId part) {
  if (part.whole()) return "whole";
  return "wedge " + std::to_string(part.number) + " of " + angle_label(part.sectors);
}

std::optional<PartId> part_of(std::string_view name) {
  if (name == name_of(PartId{})) return PartId{};
  const auto rest = after(name, "wedge_n");
  if (!rest) return std::nullopt;
  const std::size_t line = rest->find('_');
  if (line == std::string_view::npos) return std::nullopt;
  const auto sectors = whole_number(rest->substr(0, line), 2), number = whole_number(rest->substr(line + 1), 0);
  if (!sectors || !number) return std::nullopt;
  return PartId{*sectors, *number};
}

const char* name_of(MomentKind kind) { return kind == MomentKind::mean ? "mean" : "instant"; }

const char* name_of(MomentRole role) {
  const char* const names[] = {"rest", "flow", "other"};
  return names[static_cast<int>(role)];
}

std::string moment_name(const std::string& stage, MomentKind kind) {
  return kind == MomentKind::mean ? stage + "_mean" : stage;
}

const char* name_of(QuantityKind kind) {
  const char* const names[] = {"extensive", "per_height", "mean",       "share",
                               "fit",       "expected",   "coordinate", "label"};
  return names[static_cast<int>(kind)];
}

}  // namespace wedge
