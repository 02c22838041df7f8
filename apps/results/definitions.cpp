// definitions.cpp: the vocabulary as text for people and as JSON for the page of `wedge report`.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/results/vocabulary.hpp"

namespace wedge {
namespace {

struct TableName {
  ResultTable table;
  const char *name, *file, *says;
};
constexpr TableName table_names[] = {
    {in_scalars, "scalars", "scalars.csv", "Numbers of a moment and part; means are over the bed."},
    {in_distributions, "distributions", "distributions.csv", "Distributions over grains of the bed, or contacts."},
    {in_profile, "profile", "radial.csv", "Rings d/2 wide; means are over grains of the bulk."},
    {in_map, "map", "map.csv", "Cells over r and z; means of grains weighted by W, velocities also by mass."},
    {in_beds, "beds", "beds.csv", "The bed at the end of each stage, written by the run."},
    {in_pictures, "pictures", "slice.csv, network.csv, cut.csv", "Grains and contacts of pictures."},
    {in_flow, "flow", "flow.csv", "Discharge against time."},
};

/// Words in lines of at most `width` letters, each after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent, std::size_t width) {
  std::string out, line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && indent + line.size() + 1 + word.size() > width) {
      out += std::string(indent, ' ') + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return out + std::string(indent, ' ') + line + '\n';
}

}  // namespace

std::string definitions_text() {
  std::string text = wrapped(
      "d is the mean diameter of the grains at the start, theta the sector angle, W the kernel of the map. "
      "Extensive quantities are those of the whole vessel. A number that is not known is nan.",
      0, 100);
  std::vector<const ResultQuantity*> told;  // each definition stands in the first file that has the quantity
  for (const TableName& table : table_names) {
    text += std::string("\n") + table.file + ": " + table.says + "\n";
    std::string again;
    for (const ResultQuantity* q : quantities_in(table.table)) {
      if (std::find(told.begin(), told.end(), q) != told.end()) {
        again += (again.empty() ? "" : ", ") + std::string(q->name);
        continue;
      }
      told.push_back(q);
      text += "  " + heading(q->name) + " (" + name_of(q->kind) + "): " + q->label + '\n' +
              wrapped(q->definition, 6, 100);
    }
    if (!again.empty()) text += wrapped("defined above: " + again, 2, 100);
  }
  return text;
}

std::string vocabulary_json() {
  nlohmann::ordered_json all;
  all["axis_zone_arc_d"] = axis_zone_arc;
  for (const RegionKind kind : {RegionKind::axis_zone, RegionKind::rest}) {
    std::string of_sectors = name_of(RegionId{kind, 0});
    of_sectors.replace(of_sectors.size() - 1, 1, "{n}");  // in place of the number
    all["regions"][name_of(kind)] = {{"label", label_of(kind)}, {"of_sectors", of_sectors}};
  }
  for (const TableName& table : table_names)
    all["tables"].push_back({{"name", table.name}, {"file", table.file}, {"says", table.says}});
  for (const ResultQuantity& q : quantities()) {
    nlohmann::ordered_json one = {{"name", q.name},
                                  {"unit", q.unit},
                                  {"kind", name_of(q.kind)},
                                  {"label", q.label},
                                  {"definition", q.definition},
                                  {"compared", q.compared()},
                                  {"in_overview", q.in_overview},
                                  {"tables", nlohmann::ordered_json::array()}};
    for (const TableName& table : table_names)
      if (q.is_in(table.table)) one["tables"].push_back(table.name);
    all["quantities"].push_back(std::move(one));
  }
  return all.dump(1) + "\n";
}

}  // namespace wedge
