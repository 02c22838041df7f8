// flank.cpp: the highest grains of a pile and the line through them.
#include "apps/measure/flank.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/time_scales.hpp"

namespace wedge {

std::vector<Eigen::Vector2d> mean_surface(const std::vector<Ball>& grains, double width, bool slot) {
  if (!(width > 0)) return {};
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector2d> highest;  // by ring and cell: (r, top)
  for (const Ball& grain : grains) {
    const Vec3 x = grain.centre;
    const double r = slot ? std::abs(x.x) : std::hypot(x.x, x.y);
    const auto ring = static_cast<std::size_t>(r / width);
    const double along =
        slot ? x.y : (std::atan2(x.y, x.x) + numbers::pi) * (static_cast<double>(ring) + 0.5) * width;
    const double top = x.z + grain.radius;
    const auto cell = std::make_pair(ring, static_cast<std::size_t>(std::max(0.0, along) / width));
    const auto found = highest.try_emplace(cell, r, top).first;
    if (top > found->second.y()) found->second = {r, top};
  }
  std::vector<Eigen::Vector2d> sums;
  std::vector<double> cells;
  for (const auto& [cell, point] : highest) {
    sums.resize(cell.first + 1, Eigen::Vector2d::Zero());
    cells.resize(cell.first + 1, 0);
    sums[cell.first] += point;
    cells[cell.first] += 1;
  }
  std::vector<Eigen::Vector2d> surface;
  for (std::size_t ring = 0; ring < sums.size(); ++ring)
    if (cells[ring] > 0) surface.emplace_back(sums[ring] / cells[ring]);
  return surface;
}

double peak_height(const std::vector<Eigen::Vector2d>& surface) {
  double peak = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector2d& ring : surface) peak = std::max(peak, ring.y());
  return peak;
}

double angle_of_repose(const std::vector<Eigen::Vector2d>& surface, double ground, double width) {
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  const double peak = peak_height(surface);
  if (!std::isfinite(peak)) return not_known;
  std::vector<Eigen::Vector2d> slope;
  bool outside = false;  // of the highest ring: inside it the pile of a sector may have a hollow at the axis
  const Eigen::Vector2d* inner = nullptr;
  for (const Eigen::Vector2d& ring : surface) {
    if (outside && (ring.y() > inner->y() + width || ring.x() > inner->x() + 2 * width)) break;
    inner = &ring;
    const double height = (ring.y() - ground) / (peak - ground);
    if (outside && height > 0.1 && height < 0.9) slope.push_back(ring);
    outside = outside || ring.y() == peak;
  }
  if (slope.size() < 4) return not_known;
  Eigen::Vector2d centre(0, 0);
  for (const Eigen::Vector2d& point : slope) centre += point / static_cast<double>(slope.size());
  double along = 0, squares = 0;
  for (const Eigen::Vector2d& point : slope) {
    along += (point - centre).x() * (point - centre).y();
    squares += (point - centre).x() * (point - centre).x();
  }
  return along < 0 ? std::atan(-along / squares) * 180 / numbers::pi : not_known;
}

}  // namespace wedge
