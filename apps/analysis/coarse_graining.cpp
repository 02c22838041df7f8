// coarse_graining.cpp: sums of points over a grid, row by row of the grid.
#include "apps/analysis/coarse_graining.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/time_scales.hpp"
#include "core/vec3.hpp"

namespace wedge {
namespace {

constexpr double cut = 4;  // standard deviations

double gaussian(double distance, double deviation) {
  return std::exp(-0.5 * distance * distance / (deviation * deviation));
}

/// Of the points: first column within reach, and the weight of this column and those after it.
struct Across {
  std::vector<int> first;
  std::vector<float> weights;  // `span` of each point
  int span = 0;
};

Across weights_across(const FieldGrid& grid, const FieldPoints& points) {
  const double w = grid.smoothing;
  Across across;
  across.span = std::min(grid.columns, static_cast<int>(std::ceil(2 * cut * w / grid.width)) + 1);
  across.first.resize(points.size());
  across.weights.resize(points.size() * static_cast<std::size_t>(across.span));
  for_each(static_cast<Index>(points.size()), [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    const double place = points.across[s];
    const int lowest = static_cast<int>(std::ceil((place - cut * w - grid.left) / grid.width - 0.5));
    const int first = std::clamp(lowest, 0, grid.columns - across.span);
    across.first[s] = first;
    for (int k = 0; k < across.span; ++k) {
      const double r = grid.across(first + k);
      double weight = std::abs(r - place) <= cut * w ? gaussian(r - place, w) : 0;
      if (weight > 0 && !(grid.slot_width > 0)) weight *= scaled_bessel_i0(r * place / (w * w));
      across.weights[s * static_cast<std::size_t>(across.span) + static_cast<std::size_t>(k)] =
          static_cast<float>(weight);
    }
  });
  return across;
}

/// Points by the row of the grid they lie in; those beyond its ends in the rows before the first and after the
/// last.
struct ByRow {
  std::vector<std::size_t> begin, order;
  int margin = 0;  // rows before the first
};

ByRow sorted_by_row(const FieldGrid& grid, const FieldPoints& points, int reach) {
  ByRow sorted;
  sorted.margin = reach;
  const int rows = grid.rows + 2 * reach;
  std::vector<int> row(points.size());
  sorted.begin.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double place = std::floor((points.up[i] - grid.low) / grid.height) + reach;
    row[i] = place >= 0 && place < rows ? static_cast<int>(place) : -1;
    if (row[i] >= 0) ++sorted.begin[static_cast<std::size_t>(row[i]) + 1];
  }
  for (std::size_t r = 1; r < sorted.begin.size(); ++r) sorted.begin[r] += sorted.begin[r - 1];
  sorted.order.resize(sorted.begin.back());
  std::vector<std::size_t> next(sorted.begin.begin(), sorted.begin.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (row[i] >= 0) sorted.order[next[static_cast<std::size_t>(row[i])]++] = i;
  return sorted;
}

}  // namespace

double scaled_bessel_i0(double x) {
  if (x < 3.75) {
    const double t = x / 3.75, u = t * t;
    const double i0 =
        1 + u * (3.5156229 + u * (3.0899424 + u * (1.2067492 + u * (0.2659732 + u * (0.0360768 + u * 0.0045813)))));
    return std::exp(-x) * i0;
  }
  const double u = 3.75 / x;
  return (0.39894228 +
          u * (0.01328592 +
               u * (0.00225319 +
                    u * (-0.00157565 +
                         u * (0.00916281 +
                              u * (-0.02057706 + u * (0.02635537 + u * (-0.01647633 + u * 0.00392377)))))))) /
         std::sqrt(x);
}

double FieldGrid::volume(int column) const {
  return (slot_width > 0 ? slot_width : 2 * numbers::pi * across(column)) * width * height;
}

void add_fields(const FieldGrid& grid, const FieldPoints& points, double copies, std::vector<double>& sums) {
  const auto carried = static_cast<std::size_t>(points.carried);
  const double w = grid.smoothing, square = 2 * numbers::pi * w * w;
  const double scale = copies / (grid.slot_width > 0 ? square * grid.slot_width : square * std::sqrt(square));
  const int reach = static_cast<int>(std::ceil(cut * w / grid.height));
  const Across across = weights_across(grid, points);
  const ByRow sorted = sorted_by_row(grid, points, reach);
  const auto span = static_cast<std::size_t>(across.span);
  for_each_block(grid.rows, [&](Index row) {
    const auto first = static_cast<std::size_t>(row + sorted.margin - reach);
    const std::size_t last = first + 2 * static_cast<std::size_t>(reach) + 1;
    for (std::size_t k = sorted.begin[first]; k < sorted.begin[last]; ++k) {
      const std::size_t i = sorted.order[k];
      const double rise = points.up[i] - grid.up(row);
      if (std::abs(rise) > cut * w) continue;
      const double up = scale * gaussian(rise, w);
      double* cell = &sums[grid.cell(across.first[i], row) * carried];
      for (std::size_t c = 0; c < span; ++c, cell += carried) {
        const double weight = up * static_cast<double>(across.weights[i * span + c]);
        for (std::size_t v = 0; v < carried; ++v) cell[v] += weight * points.values[i * carried + v];
      }
    }
  });
}

}  // namespace wedge
