// cell_grid.hpp: a box cut into equal cells, for finding neighbours.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/vec3.hpp"

namespace wedge {

/// Cells are numbered brick by brick, so that cells with near numbers are near each other in all directions; within
/// a brick, and brick by brick, x is fastest and z slowest. A point outside the box belongs to the nearest cell.
class CellGrid {
public:
  static constexpr Index brick_edge = 8;  // cells

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
    const auto bricks = [](Index n) { return (n + brick_edge - 1) / brick_edge; };
    bricks_x_ = bricks(nx_);
    bricks_y_ = bricks(ny_);
    bricks_z_ = bricks(nz_);
    per_metre_ = {nx_ / std::max(extent.x, size), ny_ / std::max(extent.y, size), nz_ / std::max(extent.z, size)};
  }

  /// Numbers of cells are below this; some stand for no cell of the box.
  Index cells() const { return bricks_x_ * bricks_y_ * bricks_z_ * brick_edge * brick_edge * brick_edge; }
  Index column(double x) const { return clamp((x - low_.x) * per_metre_.x, nx_); }
  Index row(double y) const { return clamp((y - low_.y) * per_metre_.y, ny_); }
  Index level(double z) const { return clamp((z - low_.z) * per_metre_.z, nz_); }
  Index cell(Vec3 p) const { return number(column(p.x), row(p.y), level(p.z)); }
  /// Number of the cell; along x numbers run on until the end of a brick.
  Index number(Index column, Index row, Index level) const {
    const Index brick = ((level / brick_edge) * bricks_y_ + row / brick_edge) * bricks_x_ + column / brick_edge;
    return ((brick * brick_edge + level % brick_edge) * brick_edge + row % brick_edge) * brick_edge +
           column % brick_edge;
  }
  /// Calls visit(first, last) for each run of cell numbers that makes up the 27 cells around p.
  template <class Visit>
  void for_each_run_around(Vec3 p, Visit&& visit) const {
    const Index c = column(p.x), r = row(p.y), l = level(p.z);
    const Index end = std::min(nx_ - 1, c + 1);
    for (Index level = std::max(0, l - 1); level <= std::min(nz_ - 1, l + 1); ++level) {
      for (Index row = std::max(0, r - 1); row <= std::min(ny_ - 1, r + 1); ++row) {
        for (Index from = std::max(0, c - 1); from <= end;) {
          const Index to = std::min(end, from / brick_edge * brick_edge + brick_edge - 1);
          const Index first = number(from, row, level);
          visit(first, first + to - from);
          from = to + 1;
        }
      }
    }
  }

private:
  static Index clamp(double c, Index n) {
    return static_cast<Index>(std::clamp(c, 0.0, static_cast<double>(n) - 0.5));
  }
  Vec3 low_, per_metre_;
  Index nx_ = 1, ny_ = 1, nz_ = 1;  // cells of the box
  Index bricks_x_ = 1, bricks_y_ = 1, bricks_z_ = 1;
};

}  // namespace wedge
