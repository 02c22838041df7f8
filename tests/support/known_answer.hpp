// known_answer.hpp: a number of ours against one we did not compute, asserted and written down.
//
// When the environment variable WEDGE_VALIDATION_ROWS names a file, every known answer and every measured order
// appends its row to it; `bash tests/run.sh --validate` makes the tables of tests/README.md of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

namespace wedge::test {

inline std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Appends one row to that file: the table's name, the place that sorts it, the cells. A row is one short
/// write at the end of the file, so tests that run at the same time do not mix theirs.
inline void write_row(const std::string& table, const std::string& place, const std::vector<std::string>& cells) {
  const char* path = std::getenv("WEDGE_VALIDATION_ROWS");
  if (!path) return;
  std::string row = table + '\t' + place + "\t|";
  for (const std::string& cell : cells) row += ' ' + cell + " |";
  row += '\n';
  std::FILE* file = std::fopen(path, "a");
  REQUIRE(file != nullptr);
  std::fwrite(row.data(), 1, row.size(), file);
  REQUIRE(std::fclose(file) == 0);
}

enum class Measure {
  relative,   // the largest |ours - reference| / |reference|
  absolute,   // the largest |ours - reference|
  full_scale  // root mean square of (ours - reference) over the range of the reference: digitised curves
};

/// One of them: `add` each number, then CHECK(answer.within(tolerance)).
class KnownAnswer {
public:
  KnownAnswer(std::string place, std::string subject, std::string source, Measure measure = Measure::relative,
              std::string unit = "")
      : place_(std::move(place)),
        subject_(std::move(subject)),
        source_(std::move(source)),
        unit_(std::move(unit)),
        measure_(measure) {}

  KnownAnswer& add(double ours, double reference) {
    const double error =
        measure_ == Measure::relative ? std::fabs(ours / reference - 1) : std::fabs(ours - reference);
    if (!(error <= worst_) || count_ == 0) {  // not a number is the worst of all
      worst_ = error;
      ours_ = ours;
      reference_ = reference;
    }
    squares_ += (ours - reference) * (ours - reference);
    low_ = std::min(low_, reference);
    high_ = std::max(high_, reference);
    ++count_;
    return *this;
  }

  double error() const {
    if (count_ == 0) return std::numeric_limits<double>::quiet_NaN();
    return measure_ == Measure::full_scale ? std::sqrt(squares_ / count_) / (high_ - low_) : worst_;
  }

  /// Writes the row; says whether the error keeps to the tolerance. A single point of a curve may be off by three
  /// times as much.
  bool within(double tolerance) const {
    const bool curve = measure_ == Measure::full_scale;
    const std::string unit = unit_.empty() ? "" : ' ' + unit_;
    const std::string error_unit = measure_ == Measure::absolute ? unit : curve ? " of full scale" : "";
    const auto value = [&](double x) {
      return curve ? std::to_string(count_) + " points" : text("%.7g", x) + unit;
    };
    write_row("known answers", place_,
              {subject_, source_, value(reference_), curve ? "" : value(ours_), text("%.1e", error()) + error_unit,
               text("%.1e", tolerance) + error_unit});
    UNSCOPED_INFO(subject_ << ": ours " << ours_ << ", reference " << reference_ << ", error " << error()
                           << error_unit << ", tolerance " << tolerance);
    return error() <= tolerance && (!curve || worst_ <= 3 * tolerance * (high_ - low_));
  }

private:
  std::string place_, subject_, source_, unit_;
  Measure measure_;
  double worst_ = 0, ours_ = 0, reference_ = 0, squares_ = 0;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
  int count_ = 0;
};

}  // namespace wedge::test
