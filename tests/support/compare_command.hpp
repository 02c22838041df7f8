// compare_command.hpp: wedge compare with its output caught, and the rows of its table.
#pragma once

#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "apps/commands/commands.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "tests/support/catch.hpp"

namespace wedge::test {

struct Said {
  int code = 0;
  std::string text, errors;
};

/// Runs the command with its output caught.
inline Said compare(const std::vector<std::string>& reference, const std::vector<std::string>& with,
                    const CompareOptions& options = {}) {
  std::ostringstream out, errors;
  std::streambuf *const screen = std::cout.rdbuf(out.rdbuf()), *const complaints = std::cerr.rdbuf(errors.rdbuf());
  Said said;
  const auto restore = [&] {
    std::cout.rdbuf(screen);
    std::cerr.rdbuf(complaints);
  };
  try {
    said.code = command_compare(reference, with, options);
  } catch (...) {
    restore();
    throw;
  }
  restore();
  said.text = out.str();
  said.errors = errors.str();
  return said;
}

inline bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

using Row = std::map<std::string, std::string>;
inline std::vector<Row> rows_of(const std::string& path) {
  std::istringstream text(read_text_file(path));
  std::vector<Row> rows;
  std::string line;
  std::getline(text, line);
  const std::vector<CsvField> names = split_csv_line(line);
  while (std::getline(text, line)) {
    const std::vector<CsvField> fields = split_csv_line(line);
    REQUIRE(fields.size() == names.size());
    Row row;
    for (std::size_t k = 0; k < names.size(); ++k) row[names[k].text] = fields[k].text;
    rows.push_back(row);
  }
  return rows;
}
inline double number(const Row& row, const std::string& column) {
  double value = 0;
  REQUIRE(parse_number(row.at(column), value) == NumberError::none);
  return value;
}

/// Every `what` of a file becomes `with`.
inline void rewrite(const std::string& path, const std::string& what, const std::string& with) {
  std::string text = read_text_file(path);
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
  write_text_file_atomically(path, text);
}

}  // namespace wedge::test
