// series.cpp: rows appended with one write(2) each, taken back when they do not fit.
#include "io/tables/series.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"

namespace wedge {
namespace {

std::string heading(const std::vector<SeriesColumn>& columns) {
  std::string line;
  for (const SeriesColumn& column : columns) {
    if (!line.empty()) line += ',';
    line += csv_quoted(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  return line + '\n';
}

/// Whether a line (without its end) is a row of `columns` numbers with a time not after `time`.
bool row_until(std::string_view line, std::size_t columns, double time) {
  const std::vector<CsvField> fields = split_csv_line(line);
  if (fields.size() != columns) return false;
  double value = 0;
  for (const CsvField& field : fields) {
    if (parse_number(field.text, value) != NumberError::none) return false;
  }
  return parse_number(fields[0].text, value) == NumberError::none && value <= time;
}

}  // namespace

SeriesFile::SeriesFile(std::string path, std::size_t columns, int open_flags)
    : path_(std::move(path)),
      columns_(columns),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | open_flags, 0666)) {
  if (descriptor_ < 0) throw_file_error(path_, "cannot write", errno);
}

SeriesFile SeriesFile::create(const std::string& path, const std::vector<SeriesColumn>& columns) {
  require(!columns.empty(), "a series without columns");
  SeriesFile file(path, columns.size(), O_CREAT | O_TRUNC);
  file.write(heading(columns));
  return file;
}

SeriesFile SeriesFile::reopen(const std::string& path, const std::vector<SeriesColumn>& columns, double time) {
  if (::access(path.c_str(), F_OK) != 0) return create(path, columns);
  const std::string text = read_text_file(path);
  const std::string first = heading(columns);
  if (text.size() < first.size() && first.compare(0, text.size(), text) == 0) return create(path, columns);  // torn
  if (text.compare(0, first.size(), first) != 0) {
    throw_file_error(path,
                     "cannot go on with this series: its columns are not " + first.substr(0, first.size() - 1));
  }
  std::size_t keep = first.size();
  for (;;) {
    const std::size_t end = text.find('\n', keep);
    if (end == std::string::npos) break;
    if (!row_until(std::string_view(text).substr(keep, end - keep), columns.size(), time)) break;
    keep = end + 1;
  }
  SeriesFile file(path, columns.size(), 0);
  if (keep < text.size() && ::ftruncate(file.descriptor_, static_cast<off_t>(keep)) != 0) {
    throw_file_error(path, "cannot cut the series back", errno);
  }
  return file;
}

SeriesFile::SeriesFile(SeriesFile&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(other.columns_),
      descriptor_(std::exchange(other.descriptor_, -1)),
      row_(std::move(other.row_)) {}

SeriesFile& SeriesFile::operator=(SeriesFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(columns_, other.columns_);
  std::swap(descriptor_, other.descriptor_);
  std::swap(row_, other.row_);
  return *this;
}

SeriesFile::~SeriesFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SeriesFile::append(const std::vector<double>& values) {
  require(values.size() == columns_, "a row with more or fewer values than the series has columns");
  row_.clear();
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (k > 0) row_ += ',';
    append_number(row_, values[k]);
  }
  row_ += '\n';
  write(row_);
}

void SeriesFile::write(const std::string& text) {
  const off_t before = ::lseek(descriptor_, 0, SEEK_END);
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int error = written == 0 ? ENOSPC : errno;
      // Take the torn row back; where that fails too, reopen() cuts it.
      if (done > 0 && before >= 0 && ::ftruncate(descriptor_, before) != 0) done = 0;
      throw_file_error(path_, "cannot write", error);
    }
    done += static_cast<std::size_t>(written);
  }
}

void SeriesFile::sync() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) throw_file_error(path_, "cannot sync", errno);
}

}  // namespace wedge
