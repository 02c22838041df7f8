// bed_table.cpp: the table of beds as text and back.
#include "apps/results/bed_table.hpp"

#include <algorithm>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

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
