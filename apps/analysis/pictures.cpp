// pictures.cpp: turns grains into the plane of a slice and picks those near it.
#include "apps/analysis/pictures.hpp"

#include <cmath>

namespace wedge {
namespace {

/// Turns a place of copy k of the domain so that the slice is the plane y = 0.
class SliceAxes {
public:
  explicit SliceAxes(const MeasuredDomain& domain)
      : domain_(domain), angle_(domain.order > 1 ? 0.5 * domain.theta : 0) {}

  Vec3 seen(Vec3 place, int turn) const {
    const Vec3 p = domain_.symmetry.turn_point(place, turn);
    if (domain_.slot) return {p.x, p.y - 0.5 * domain_.scene.domain.slot_width, p.z};
    const double c = std::cos(angle_), s = std::sin(angle_);
    return {c * p.x + s * p.y, c * p.y - s * p.x, p.z};
  }
  bool shows(Vec3 p) const { return std::abs(p.y) <= 2 * domain_.diameter && (domain_.order == 1 || p.x >= 0); }
  /// Turns whose copies can come near the slice.
  int first() const { return domain_.symmetry.periodic() ? -turns() : 0; }
  int last() const { return domain_.symmetry.periodic() ? turns() : 0; }

private:
  int turns() const { return domain_.slot ? 1 : (domain_.symmetry.order() - 1) / 2; }
  const MeasuredDomain& domain_;
  double angle_;
};

}  // namespace

SlicePicture slice_picture(const MeasuredDomain& domain, const Bed& bed) {
  const SliceAxes axes(domain);
  SlicePicture picture;
  for (int turn = axes.first(); turn <= axes.last(); ++turn) {
    for (const BedGrain& g : bed.grains) {
      const Vec3 seen = axes.seen(g.position, turn);
      if (g.in_bed && axes.shows(seen)) picture.grains.push_back({seen, &g});
    }
    for (const BedContact& c : bed.contacts) {
      const Vec3 from = axes.seen(c.from, turn), to = axes.seen(c.to, turn);
      if (bed.grains[static_cast<std::size_t>(c.first)].in_bed && axes.shows(from) && axes.shows(to))
        picture.lines.push_back({from, to, c.load});
    }
  }
  return picture;
}

std::vector<PictureGrain> cut_picture(const MeasuredDomain& domain, const Bed& bed, double z) {
  std::vector<PictureGrain> grains;
  for (const BedGrain& g : bed.grains)
    if (g.in_bed && std::abs(g.position.z - z) <= domain.diameter) grains.push_back({g.position, &g});
  return grains;
}

}  // namespace wedge
