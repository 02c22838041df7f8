// test_series.cpp: series grow row by row and are cut back to a moment.
#include <limits>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/series.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

const std::vector<SeriesColumn> columns = {{"time", "s"}, {"kinetic", "J"}, {"count", ""}};
const std::string heading = "time [s],kinetic [J],count\n";

void append_text(const std::string& path, const std::string& text) {
  write_text_file_atomically(path, read_text_file(path) + text);
}

}  // namespace

TEST_CASE("rows are in the file as soon as they are appended") {
  const ScratchFolder folder;
  SeriesFile series = SeriesFile::create(folder / "e.csv", columns);
  CHECK(read_text_file(folder / "e.csv") == heading);
  series.append({0, 0.1 + 0.2, 100000});
  CHECK(read_text_file(folder / "e.csv") == heading + "0,0.30000000000000004,100000\n");
  SeriesFile moved = std::move(series);
  moved.append({0.5, -1e-30, 2});
  moved.sync();
  CHECK(read_text_file(folder / "e.csv") == heading + "0,0.30000000000000004,100000\n0.5,-1e-30,2\n");
  SeriesFile::create(folder / "e.csv", columns);
  CHECK(read_text_file(folder / "e.csv") == heading);
}

TEST_CASE("reopening keeps the rows up to a time and goes on behind them") {
  const ScratchFolder folder;
  const std::string path = folder / "e.csv";
  {
    SeriesFile series = SeriesFile::create(path, columns);
    for (const double t : {0.0, 0.1, 0.1, 0.1 + 0.2, 0.4})
      series.append({t, std::numeric_limits<double>::infinity(), 1});
  }
  const std::string kept = heading + "0,inf,1\n0.1,inf,1\n0.1,inf,1\n";
  {
    SeriesFile series = SeriesFile::reopen(path, columns, 0.3);  // 0.1 + 0.2 is later
    CHECK(read_text_file(path) == kept);
    series.append({0.35, 2, 3});
  }
  CHECK(read_text_file(path) == kept + "0.35,2,3\n");
  SeriesFile::reopen(path, columns, 1);
  CHECK(read_text_file(path) == kept + "0.35,2,3\n");
  SeriesFile::reopen(path, columns, 0.1);  // rows at the very time stay
  CHECK(read_text_file(path) == kept);
  SeriesFile::reopen(path, columns, -1);
  CHECK(read_text_file(path) == heading);
}

TEST_CASE("a torn last line is cut") {
  const ScratchFolder folder;
  const std::string path = folder / "e.csv";
  for (const std::string& torn : {std::string("0.2,3"), std::string("0.2,3,4"), std::string("0.2,3\n"),
                                  std::string(10, '\0'), std::string("0.2,3,x\n")}) {
    write_text_file_atomically(path, heading + "0.1,2,3\n");
    append_text(path, torn);
    SeriesFile series = SeriesFile::reopen(path, columns, 1);
    CHECK(read_text_file(path) == heading + "0.1,2,3\n");
  }
  write_text_file_atomically(path, heading.substr(0, 7));  // torn within the heading
  SeriesFile::reopen(path, columns, 1);
  CHECK(read_text_file(path) == heading);
}

TEST_CASE("a series that is missing is made, one with other columns is refused") {
  const ScratchFolder folder;
  SeriesFile::reopen(folder / "new.csv", columns, 1);
  CHECK(read_text_file(folder / "new.csv") == heading);
  write_text_file_atomically(folder / "other.csv", "time [s],kinetic [kJ],count\n0,1,2\n");
  CHECK_THROWS_WITH(SeriesFile::reopen(folder / "other.csv", columns, 1),
                    Contains("other.csv") && Contains("kinetic [J]"));
  CHECK(read_text_file(folder / "other.csv") == "time [s],kinetic [kJ],count\n0,1,2\n");
}

TEST_CASE("a series on a full disk fails in one clear line and leaves no torn row") {
  CHECK_THROWS_WITH(SeriesFile::create("/dev/full", columns),
                    Contains("/dev/full: cannot write: No space left on device"));
  const ScratchFolder folder;
  CHECK_THROWS_WITH(SeriesFile::create(folder / "no/e.csv", columns),
                    Contains("no/e.csv: cannot write: No such file"));
  SeriesFile series = SeriesFile::create(folder / "e.csv", columns);
  series.append({0, 1, 2});
  const std::string before = read_text_file(folder / "e.csv");
  {
    const FileSizeLimit limit(before.size() + 3);  // half a row fits
    CHECK_THROWS_WITH(series.append({1, 1, 2}), Contains("e.csv: cannot write: File too large"));
    CHECK(read_text_file(folder / "e.csv") == before);
  }
  series.append({2, 1, 2});
  CHECK(read_text_file(folder / "e.csv") == before + "2,1,2\n");
}

TEST_CASE("a row of the wrong length is a bug, not a row") {
  const ScratchFolder folder;
  SeriesFile series = SeriesFile::create(folder / "e.csv", columns);
  CHECK_THROWS_AS(series.append({1, 2}), std::logic_error);
  CHECK(read_text_file(folder / "e.csv") == heading);
}
