// axis_velocity.hpp: what the axis does to velocities after a kick. For one grain, or for a pack of them.
#pragma once

#include <type_traits>
#include <variant>

#include "core/axis.hpp"
#include "core/pack.hpp"

namespace wedge {

/// The rule `clamp` (Yang et al. 2014, eqs 12-17): a grain whose surface reaches the axis and that moves towards it
/// loses its radial velocity.
template <class Real>
WEDGE_INLINE Vector3<Real> clamped_at_axis(const Vector3<Real>& v, const Vector3<Real>& position,
                                           const Real& radius) {
  const Real r2 = position.x * position.x + position.y * position.y;
  const Real outward = position.x * v.x + position.y * v.y;  // r v_r
  const Real nearest = 2 * axis_resolution * radius;
  const auto reaches = r2 < radius * radius && r2 >= nearest * nearest && outward < 0;
  if (!any_lane(reaches)) return v;  // most grains are far from the axis
  const Real take = select(reaches, outward / r2, Real(0.0));
  return {v.x - take * position.x, v.y - take * position.y, v.z};
}

/// The rule `pin`: a grain on the axis has no velocity but along it. So it stays there.
template <class Real>
WEDGE_INLINE Vector3<Real> pinned_at_axis(const Vector3<Real>& v, const Vector3<Real>& position,
                                          const Real& radius) {
  const Real keep = select(on_axis(position.x, position.y, radius), Real(0.0), Real(1.0));
  return {keep * v.x, keep * v.y, v.z};
}

/// The velocity that the axis leaves to a grain at `position` [m].
template <AxisAction action, class Real>
WEDGE_INLINE Vector3<Real> at_axis(const Vector3<Real>& v, const Vector3<Real>& position, const Real& radius) {
  if constexpr (action == AxisAction::clamp) return clamped_at_axis(v, position, radius);
  if constexpr (action == AxisAction::pin) return pinned_at_axis(v, position, radius);
  return v;
}

/// The actions as types of a loop.
template <AxisAction action>
using AxisActionType = std::integral_constant<AxisAction, action>;
using AnyAxisAction = std::variant<AxisActionType<AxisAction::none>, AxisActionType<AxisAction::clamp>,
                                   AxisActionType<AxisAction::pin>>;
inline AnyAxisAction as_type(AxisAction action) {
  switch (action) {
    case AxisAction::clamp:
      return AxisActionType<AxisAction::clamp>{};
    case AxisAction::pin:
      return AxisActionType<AxisAction::pin>{};
    case AxisAction::none:
      break;
  }
  return AxisActionType<AxisAction::none>{};
}

}  // namespace wedge
