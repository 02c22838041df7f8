// result_file.cpp: rows of a table, those of unwanted parts passed over before they are taken apart.
#include "apps/comparison/result_file.hpp"

#include <algorithm>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"

namespace wedge {
namespace {

Heading heading_of(const std::string& text) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos || text.back() != ']') return {text, ""};
  return {text.substr(0, bracket), text.substr(bracket + 2, text.size() - bracket - 3)};
}

/// The second field of a line; the file is big, so no other field is looked at.
std::string part_field(std::string_view line) {
  if (line.find('"') != std::string_view::npos) {
    const std::vector<CsvField> fields = split_csv_line(line);
    return fields.size() > 1 ? fields[1].text : "";
  }
  const std::size_t begin = line.find(',');
  if (begin == std::string_view::npos) return "";
  const std::size_t end = std::min(line.find(',', begin + 1), line.size());
  return std::string(line.substr(begin + 1, end - begin - 1));
}

}  // namespace

ResultFile::ResultFile(std::string path) : path_(std::move(path)), content_(read_text_file(path_)) {
  std::string_view line;
  if (!next_line(line)) refuse("the file is empty");
  for (const CsvField& field : split_csv_line(line)) headings_.push_back(heading_of(field.text));
  if (headings_.size() < 2 || headings_[0].name != "moment" || headings_[1].name != "part")
    refuse("this is not a table of `wedge analyse`: its first columns must be moment and part");
}

std::size_t ResultFile::column(const std::string& name) const {
  const auto found = std::find_if(headings_.begin(), headings_.end(),
                                  [&](const Heading& heading) { return heading.name == name; });
  if (found == headings_.end()) refuse("there is no column '" + name + "'");
  return static_cast<std::size_t>(found - headings_.begin());
}

bool ResultFile::next(const std::function<bool(PartId)>& wanted) {
  std::string_view line;
  while (next_line(line)) {
    if (line.empty()) continue;
    const std::string name = part_field(line);
    const auto part = part_of(name);
    if (!part) refuse_name(name, "a part");
    part_ = *part;
    if (!wanted(part_)) continue;
    fields_ = split_csv_line(line);
    if (fields_.size() != headings_.size()) refuse("expected " + std::to_string(headings_.size()) + " fields");
    return true;
  }
  return false;
}

double ResultFile::number(std::size_t column) const { return number_of(fields_[column].text); }

std::vector<double> ResultFile::numbers(std::size_t column) const {
  const std::string_view all = fields_[column].text;
  std::vector<double> found;
  for (std::size_t begin = all.find_first_not_of(' '); begin < all.size();
       begin = all.find_first_not_of(' ', begin)) {
    const std::size_t end = std::min(all.find(' ', begin), all.size());
    found.push_back(number_of(all.substr(begin, end - begin)));
    begin = end;
  }
  return found;
}

void ResultFile::refuse(const std::string& what) const {
  throw FileError(path_ + ":" + std::to_string(std::max<std::size_t>(line_, 1)) + ": error: " + what);
}

void ResultFile::refuse_name(const std::string& name, const std::string& what) const {
  refuse("'" + name + "' is not " + what +
         " that this version of wedge knows; measure the run again: wedge analyse DIR");
}

bool ResultFile::next_line(std::string_view& line) {
  if (at_ >= content_.size()) return false;
  const std::size_t end = std::min(content_.find('\n', at_), content_.size());
  line = std::string_view(content_).substr(at_, end - at_);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  at_ = end + 1;
  ++line_;
  return true;
}

double ResultFile::number_of(std::string_view text) const {
  double value = 0;
  if (parse_number(text, value) != NumberError::none) refuse("'" + std::string(text) + "' is not a number");
  return value;
}

}  // namespace wedge
