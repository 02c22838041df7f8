// contact_geometry.cpp: the first loop over the packs of a slab.
#include "kernels/passes/contact_geometry.hpp"

#include "kernels/laws/contact_law.hpp"
#include "kernels/laws/history.hpp"
#include "kernels/passes/contact_kinematics.hpp"

namespace wedge {
namespace {

/// Overlap [m] of a pack of rows, zero while they are apart: the sum of the radii less the distance; in single
/// precision the same from the difference of their squares, which is one of doubles.
WEDGE_INLINE Pack overlap_of(const SeenSlab<double>&, Index, const Pack& radii, const Pack& distance) {
  using std::max;
  return max(Pack(0), radii - distance);
}
WEDGE_INLINE PackOf<float> overlap_of(const SeenSlab<float>& of, Index row, const PackOf<float>& radii,
                                      const PackOf<float>& distance) {
  using std::max;
  return max(PackOf<float>(0), of.closeness.load(row) / (radii + distance));
}

}  // namespace

template <Friction friction, bool alike, class Number>
void approach(Number radius, const ForceStep<Number>& step, const SeenSlab<Number>& of, const StoredSlab& stored,
              Index rows, ContactSlab<Number>& to) {
  using std::sqrt;
  using Real = PackOf<Number>;
  using Vector = Vector3<Real>;
  for (Index row = 0; row < rows; row += lanes<Number>) {
    const Real radius_first = alike ? Real(radius) : of.radius_first.load(row);
    const Real radius_second = alike ? Real(radius) : of.radius_second.load(row);
    const Vector d = -of.apart.load(row);
    const Real distance = sqrt(dot(d, d)), inverse = 1 / distance;
    const Vector n = inverse * d;
    const Real overlap = overlap_of(of, row, radius_first + radius_second, distance);
    const Vector v = of.speed.load(row);
    to.overlap.store(row, overlap);
    to.normal.store(row, n);
    if constexpr (friction == Friction::none) {
      to.approach.store(row, dot(v, n));
    } else {
      // The second grain was at d + dt v seen from the first, so the normal along n + back.
      const Vector back = (step.dt * inverse) * (v - dot(v, n) * n);
      if constexpr (friction == Friction::spring) to.back.store(row, back);
      const Vector spins = of.spins.load(row);
      const Vector spin_difference = alike ? Vector{} : of.spin_difference.load(row);
      const ContactVelocity<Real> seen = along_and_across(
          surface_velocity<alike>(v, spins, spin_difference, d, n, Real(radius_first - radius_second)), n);
      const Vector before = stored.history.load<Real>(row);
      const Vector followed = follow_turning_normal(before, back, n);
      to.approach.store(row, seen.approach);
      to.tangential_velocity.store(row, seen.tangential);
      to.displacement.store(row, turn_with_spins(followed, n, spins, step.dt) +
                                     slip_time(before, overlap, seen.approach, step.dt) * seen.tangential);
    }
  }
}

// Couples run in the loops for grains of any kind.
#define WEDGE_APPROACH(friction, alike)                                                              \
  template void approach<friction, alike>(double, const ForceStep<double>&, const SeenSlab<double>&, \
                                          const StoredSlab&, Index, ContactSlab<double>&);           \
  template void approach<friction, alike>(float, const ForceStep<float>&, const SeenSlab<float>&,    \
                                          const StoredSlab&, Index, ContactSlab<float>&);
WEDGE_APPROACH(Friction::none, true)
WEDGE_APPROACH(Friction::none, false)
WEDGE_APPROACH(Friction::sliding, true)
WEDGE_APPROACH(Friction::sliding, false)
WEDGE_APPROACH(Friction::rolling, true)
WEDGE_APPROACH(Friction::rolling, false)
WEDGE_APPROACH(Friction::relative, false)
WEDGE_APPROACH(Friction::spring, false)
#undef WEDGE_APPROACH

}  // namespace wedge
