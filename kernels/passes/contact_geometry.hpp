// contact_geometry.hpp: what the rows of a slab see of their contacts: overlap, normal, velocities, and the stored
// displacement carried along to this moment. The same for every law.
#pragma once

#include "kernels/laws/friction.hpp"
#include "kernels/passes/slab.hpp"

namespace wedge {

/// The stored vectors of a slab of rows, three numbers a row: in the contact table, or in columns for the rows at
/// the end of a tile, which do not fill a slab. Doubles, whatever the width of the work on them.
struct StoredVectors {
  double *x = nullptr, *y = nullptr, *z = nullptr;
  template <class Real>
  WEDGE_INLINE Vector3<Real> load(Index row) const {
    return {wedge::load<Real>(x + row), wedge::load<Real>(y + row), wedge::load<Real>(z + row)};
  }
  template <class Real>
  WEDGE_INLINE void store(Index row, const Vector3<Real>& v) const {
    wedge::store(x + row, v.x);
    wedge::store(y + row, v.y);
    wedge::store(z + row, v.z);
  }
};
struct StoredSlab {
  StoredVectors history, couple, rolling_moment;
};

/// What the law sees of the rows of a slab.
template <class Number>
struct ContactSlab {
  ColumnOf<Number> overlap, approach;
  VectorColumnsOf<Number> normal, back, tangential_velocity, displacement;
};

/// Constants of a force step.
template <class Number>
struct ForceStep {
  Number dt;               // s, since the last force step
  Number rolling_damping;  // of critical, of rolling springs
};

/// Geometry of each row, and transport of its history. `radius` [m] is that of all grains where they are `alike`.
/// The displacement grows by the trapezoidal rule from first touch on: what is stored between steps is
/// delta + (dt/2) v_t, so that the next half step needs no old velocity (kernels/README.md, "Stored displacement").
/// Compiled once, in contact_geometry.cpp.
template <Friction friction, bool alike, class Number>
void approach(Number radius, const ForceStep<Number>& step, const SeenSlab<Number>& of, const StoredSlab& stored,
              Index rows, ContactSlab<Number>& to);

}  // namespace wedge
