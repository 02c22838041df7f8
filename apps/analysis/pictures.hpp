// pictures.hpp: the grains and contacts that a picture of a bed shows: a slice through the axis and a horizontal
// cut.
#pragma once

#include <vector>

#include "apps/measure/bed.hpp"

namespace wedge {

struct PictureGrain {
  Vec3 position;  // m; of a slice x along its half plane, y off it
  const BedGrain* grain;
};

struct PictureLine {
  Vec3 from, to;  // m, in the axes of the slice
  double load;    // N
};

struct SlicePicture {
  std::vector<PictureGrain> grains;
  std::vector<PictureLine> lines;
};

/// Grains of the bed, images included, within two mean diameters of the half plane in the middle of the sector, and
/// the contacts between them; of a full vessel or a slot within that distance of the middle plane along x, both
/// halves.
SlicePicture slice_picture(const MeasuredDomain& domain, const Bed& bed);

/// Grains of the domain within a mean diameter of the height z [m].
std::vector<PictureGrain> cut_picture(const MeasuredDomain& domain, const Bed& bed, double z);

}  // namespace wedge
