// text_table.cpp: padding, and units that suit the size of a number.
#include "apps/results/text_table.hpp"

#include <algorithm>
#include <cmath>

#include "io/scene/diagnostics.hpp"

namespace wedge {
namespace {

/// Letters of a UTF-8 text.
std::size_t length(const std::string& word) {
  return static_cast<std::size_t>(std::count_if(
      word.begin(), word.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// `value` with two significant digits below 10, else none after the point.
std::string rough(double value) {
  return short_number(value < 10 ? std::round(10 * value) / 10 : std::round(value));
}

}  // namespace

std::string TextTable::text(const std::string& indent) const {
  std::vector<std::size_t> widths;
  for (const auto& row : rows_) {
    if (row.size() > widths.size()) widths.resize(row.size(), 0);
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], length(row[k]));
  }
  std::string out;
  for (const auto& row : rows_) {
    std::string line = indent;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - length(row[k]), ' ');
      line += (k > 0 ? "  " : "") + (k == 0 ? row[k] + padding : padding + row[k]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    out += line + '\n';
  }
  return out;
}

std::string size_text(double bytes) {
  const char* const units[] = {"B", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 999.5 && unit < 5) {
    bytes /= 1000;
    ++unit;
  }
  return rough(bytes) + " " + units[unit];
}

}  // namespace wedge
