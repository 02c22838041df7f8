// cell_grid.hpp: a box cut into equal cells, for finding neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/vec3.hpp"

namespace wedge {

/// Cells are numbered x fastest, z slowest. A point outside the box belongs to the nearest cell.
class CellGrid {
public:
  CellGrid() = default;
  /// Cells of at least `cell_size` [m] over the box low..high; larger ones if the box would need more than `most`
  /// cells.
  CellGrid(Vec3 low, Vec3 high, double cell_size, std::int64_t most) : low_(low) {
    const Vec3 extent = high - low;
    double size = cell_size;
    const auto along = [&](double length) {
      return std::max<std::int64_t>(1, static_cast<std::int64_t>(length / size));
    };
    const double fill = std::cbrt(std::max(1.0, extent.x / size) * std::max(1.0, extent.y / size) *
                                  std::max(1.0, extent.z / size) / static_cast<double>(most));
    if (fill > 1) size *= fill;
    while (along(extent.x) * along(extent.y) * along(extent.z) > most) size *= 1.25;
    nx_ = static_cast<Index>(along(extent.x));
    ny_ = static_cast<Index>(along(extent.y));
    nz_ = static_cast<Index>(along(extent.z));
    per_metre_ = {nx_ / std::max(extent.x, size), ny_ / std::max(extent.y, size), nz_ / std::max(extent.z, size)};
  }

  Index cells() const { return nx_ * ny_ * nz_; }
  Index nx() const { return nx_; }
  Index ny() const { return ny_; }
  Index nz() const { return nz_; }
  Index column(double x) const { return clamp((x - low_.x) * per_metre_.x, nx_); }
  Index row(double y) const { return clamp((y - low_.y) * per_metre_.y, ny_); }
  Index level(double z) const { return clamp((z - low_.z) * per_metre_.z, nz_); }
  Index cell(Vec3 p) const { return (level(p.z) * ny_ + row(p.y)) * nx_ + column(p.x); }

private:
  static Index clamp(double c, Index n) {
    return static_cast<Index>(std::clamp(c, 0.0, static_cast<double>(n) - 0.5));
  }
  Vec3 low_, per_metre_;
  Index nx_ = 1, ny_ = 1, nz_ = 1;
};

}  // namespace wedge
