// vocabulary.hpp: the one place that names what wedge measures: quantities, regions, parts, moments.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wedge {

/// What a number is, which decides how it adds up and whether it is compared.
enum class QuantityKind {
  extensive,   // a sum over the whole vessel: n times that of a sector or wedge
  per_height,  // an extensive one per height of the bed
  mean,        // over grains, contacts or space
  share,       // a part of a whole, 0 to 1
  fit,         // a number of a line or surface fitted to the bed
  expected,    // what a published law expects of this bed
  coordinate,  // where a row of a table lies; not compared
  label,       // which one of several, or a note on the row; not compared
};
const char* name_of(QuantityKind kind);

/// Files that have a quantity, as bits of ResultQuantity::tables.
enum ResultTable : unsigned {
  in_scalars = 1,
  in_distributions = 2,
  in_profile = 4,
  in_map = 8,
  in_beds = 16,
  in_pictures = 32,
  in_flow = 64,
};
struct ResultQuantity {
  const char* name;  // in every file
  const char* unit;  // "" for a pure number
  QuantityKind kind;
  unsigned tables;
  const char* label;       // for people
  const char* definition;  // a sentence or two
  bool in_overview;        // shown where there is room for a few

  bool is_in(ResultTable table) const { return (tables & table) != 0; }
  /// Whether a comparison of two sets of runs compares it.
  bool compared() const { return kind != QuantityKind::coordinate && kind != QuantityKind::label; }
};

/// All of them, in the order in which people read them.
const std::vector<ResultQuantity>& quantities();
/// Those of one file.
std::vector<const ResultQuantity*> quantities_in(ResultTable table);
/// nullptr: there is none of this name.
const ResultQuantity* find_quantity(std::string_view name);
/// Pre: it exists.
const ResultQuantity& quantity(std::string_view name);
/// "vr [m/s]": the heading of a column. Pre: it exists.
std::string heading(std::string_view name);
/// ",r [m],cn": the headings of columns, each after a comma. Pre: they exist.
std::string headings(const std::vector<const char*>& names);
/// Column of beds.csv with the vertical load on a wall: the quantity `wall_load` of this wall.
std::string wall_load_name(const std::string& wall);
/// The weight of rows of profiles and maps.
inline constexpr const char* row_weight = "grains";

/// Where the axis zone of a sector ends, as an arc in mean diameters: below it the coordination number deviates
/// (Yang et al. 2014).
inline constexpr double axis_zone_arc = 4;
/// The same as a distance from the axis [m], of a sector that is one of `sectors`; `diameter` [m]: measured mean of
/// the run's grains at its start.
double axis_zone_edge(int sectors, double diameter);

/// Sector angle for the command line, to six decimals: "90", "51.428571".
std::string angle_text(int sectors);
/// For people, to one decimal: "90°", "51.4°".
std::string angle_label(int sectors);
/// How many sectors of this angle [degrees] make the vessel, when the text is 360 over a whole number from 2 to
/// 360, rounded to the decimals it has.
std::optional<int> sectors_of(const std::string& degrees);

enum class RegionKind { all, axis_zone, rest };
/// A range of distances from the axis: all, or the axis zone of one of `sectors`, or what lies outside it.
struct RegionId {
  RegionKind kind = RegionKind::all;
  int sectors = 0;
};
const char* name_of(RegionKind kind);   // "axis_zone"
const char* label_of(RegionKind kind);  // "axis zone"
std::string name_of(RegionId region);   // "axis_zone_n4"
std::string label_of(RegionId region);  // "axis zone of 90°"
std::optional<RegionId> region_of(std::string_view name);

/// The whole domain, or a wedge cut from a full vessel: number 0, 1, ... of those as wide as one of `sectors`.
struct PartId {
  int sectors = 0, number = 0;
  bool whole() const { return sectors == 0; }
};
std::string name_of(PartId part);   // "whole", "wedge_n4_0"
std::string label_of(PartId part);  // "wedge 0 of 90°"
std::optional<PartId> part_of(std::string_view name);

enum class MomentKind { instant, mean };
/// What the bed does meanwhile: it has come to rest, or it flows because a wall was taken away or grains leave.
enum class MomentRole { rest, flow, other };
const char* name_of(MomentKind kind);
const char* name_of(MomentRole role);
/// Of a stage or the window: "flow", "flow_mean".
std::string moment_name(const std::string& stage, MomentKind kind);
/// The span of `wedge analyse --from --to`, in place of a stage.
inline constexpr const char* window_name = "window";

/// All definitions as plain text for people, by file.
std::string definitions_text();
/// The vocabulary for the page of `wedge report`, as JSON.
std::string vocabulary_json();

}  // namespace wedge
