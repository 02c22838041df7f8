// coarse_graining.hpp: fields over (r, z) from what grains and contacts carry, by a Gaussian averaged over azimuth.
//
// W(r, z; r_i, z_i) = (2 pi w^2)^(-3/2) exp(-((r - r_i)^2 + (z - z_i)^2) / (2 w^2)) I0e(r r_i / w^2): the mean over
// the azimuth of the ring (r, z) of a Gaussian of standard deviation w in space around a point at (r_i, z_i);
// I0e(x) = exp(-x) I0(x), from the integral of exp(x cos phi) over phi (Abramowitz & Stegun 9.6.16). A sector's
// images lie at other azimuths and have the same mean. In a slot (x for r) the mean is over the width: (2 pi
// w^2)^(-1) / width times the exponential. Cut where r - r_i or z - z_i exceeds 4 w, which leaves out 1e-4 of the
// weight.
#pragma once

#include <cstddef>
#include <vector>

namespace wedge {

/// exp(-x) I0(x), x >= 0, to 2e-7 (Abramowitz & Stegun 9.8.1, 9.8.2).
double scaled_bessel_i0(double x);

/// Middles of cells of the (r, z) half plane, or of the (x, z) plane of a slot.
struct FieldGrid {
  double left = 0, low = 0;      // m, where the first cell begins
  double width = 0, height = 0;  // m, of a cell
  int columns = 0, rows = 0;
  double smoothing = 0;   // m, standard deviation w
  double slot_width = 0;  // m, along y; 0: (r, z), not a slot

  double across(int column) const { return left + (column + 0.5) * width; }
  double up(int row) const { return low + (row + 0.5) * height; }
  std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
  /// Volume of the ring, or of the bar along y, that a cell stands for [m3].
  double volume(int column) const;
};

/// Points that carry `carried` numbers each.
struct FieldPoints {
  explicit FieldPoints(int numbers) : carried(numbers) {}
  int carried;
  std::vector<double> across, up;  // m
  std::vector<double> values;      // `carried` of each point, one after the other

  std::size_t size() const { return across.size(); }
};

/// Adds sum of values times W to `sums` (cells times carried numbers, zero at first), times `copies`. Parallel over
/// the rows of the grid; each cell sums its points in their order, whatever the number of threads.
void add_fields(const FieldGrid& grid, const FieldPoints& points, double copies, std::vector<double>& sums);

}  // namespace wedge
