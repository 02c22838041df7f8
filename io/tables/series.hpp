// series.hpp: tables that grow while a run goes on: one row at a time, cut back to a moment when a run resumes.
#pragma once

#include <string>
#include <vector>

namespace wedge {

/// A column of a series; its heading in the file is "name [unit]", or "name" when it has no unit.
struct SeriesColumn {
  std::string name;
  std::string unit;
};

/// A file of comma-separated values whose first column is the time and whose rows never go back in time. Each row
/// goes to the system at once and whole: a killed program leaves no half of it, and a full disk none either.
class SeriesFile {
public:
  /// Makes or empties the file and writes the heading. Throws FileError. Pre: at least one column.
  static SeriesFile create(const std::string& path, const std::vector<SeriesColumn>& columns);
  /// Opens an existing file and cuts it back to the rows with time <= `time` [s]; the first row that is later, torn
  /// or not numbers goes, with all that follow it. A missing file is made anew. Throws FileError, also when the
  /// file has other columns.
  static SeriesFile reopen(const std::string& path, const std::vector<SeriesColumn>& columns, double time);

  SeriesFile(SeriesFile&& other) noexcept;
  SeriesFile& operator=(SeriesFile&& other) noexcept;
  ~SeriesFile();

  /// Appends one row. Throws FileError. Pre: as many values as columns.
  void append(const std::vector<double>& values);
  /// Waits until all rows are on the disk. Throws FileError.
  void sync();
  const std::string& path() const { return path_; }

private:
  SeriesFile(std::string path, std::size_t columns, int open_flags);
  void write(const std::string& text);

  std::string path_;
  std::size_t columns_ = 0;
  int descriptor_ = -1;
  std::string row_;
};

}  // namespace wedge
