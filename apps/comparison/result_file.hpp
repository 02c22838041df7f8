// result_file.hpp: a table of numbers and words with a header line, row by row, with its place in every complaint.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/results/vocabulary.hpp"
#include "io/tables/csv.hpp"

namespace wedge {

/// "name [unit]" taken apart.
struct Heading {
  std::string name, unit;
};

class ResultFile {
public:
  /// Reads the header. Throws FileError.
  explicit ResultFile(std::string path);

  const std::vector<Heading>& headings() const { return headings_; }
  /// Column of this name. Throws FileError.
  std::size_t column(const std::string& name) const;
  /// Goes on to the next row whose part is wanted; false: there is none. Throws FileError for a part that the
  /// vocabulary does not name.
  bool next(const std::function<bool(PartId)>& wanted);
  /// Of this row.
  PartId part() const { return part_; }
  const std::string& text(std::size_t column) const { return fields_[column].text; }
  double number(std::size_t column) const;
  /// Numbers parted by blanks.
  std::vector<double> numbers(std::size_t column) const;

  [[noreturn]] void refuse(const std::string& what) const;
  /// Refuses a name that the vocabulary of this version does not have.
  [[noreturn]] void refuse_name(const std::string& name, const std::string& what) const;

private:
  bool next_line(std::string_view& line);
  double number_of(std::string_view text) const;

  std::string path_, content_;
  std::size_t at_ = 0, line_ = 0;
  std::vector<Heading> headings_;
  std::vector<CsvField> fields_;
  PartId part_;
};

}  // namespace wedge
