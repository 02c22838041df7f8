// curve.hpp: reads a digitised curve of tests/known/reference.
#pragma once

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"

namespace wedge::test {

struct CurvePoint {
  double x, y;
};

/// The points under the line that begins with "# heading", up to the next line with a '#'; all points when the
/// heading is empty.
inline std::vector<CurvePoint> reference_curve(const std::string& file, const std::string& heading = "") {
  std::istringstream in(read_text_file(WEDGE_SOURCE_DIR "/tests/known/reference/" + file));
  std::vector<CurvePoint> points;
  bool reading = heading.empty();
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] == '#') {
      if (!heading.empty()) reading = line.rfind("# " + heading, 0) == 0;
      continue;
    }
    std::replace(line.begin(), line.end(), ',', ' ');
    CurvePoint p{};
    if (std::istringstream fields(line); reading && fields >> p.x >> p.y) points.push_back(p);
  }
  REQUIRE(points.size() >= 5);
  return points;
}

/// A curve between its points.
inline double interpolate(const std::vector<CurvePoint>& curve, double x) {
  auto right = std::find_if(curve.begin() + 1, curve.end() - 1, [&](const CurvePoint& p) { return p.x >= x; });
  const auto left = right - 1;
  return left->y + (right->y - left->y) * (x - left->x) / (right->x - left->x);
}

}  // namespace wedge::test
