// axis.hpp: what may happen at the axis of a sector, and all that tells one treatment from another.
//
// A new treatment: its name and its traits here, its word in io/scene/names.hpp, its test in
// tests/kernels/test_axis.cpp and, if it acts on velocities in a way of its own, a rule in
// kernels/passes/axis_velocity.hpp. All else asks the traits.
#pragma once

namespace wedge {

/// What happens at the axis of a sector (apps/scenes/README.md).
enum class AxisRule {
  clamp,   // a grain that reaches the axis loses its velocity towards it (Yang et al. 2014)
  images,  // every copy acts, a grain's own copies included: exact symmetry
  pin,     // a grain on the axis stays there for good and meets all copies of its neighbours (Cui et al. 2007)
  line,    // a rigid, frictional line along the axis
  hollow   // an inner cylinder cuts the axis out; every copy acts
};

/// Which copies of a grain act on the grains of the domain: those in the copies beside it, or every one, its own
/// included.
enum class CopiesActing { beside, every };
/// What the axis does to velocities after each half kick.
enum class AxisAction { none, clamp, pin };
/// What stands around the axis as a wall.
enum class AxisWall { none, line, cylinder };

struct AxisTraits {
  CopiesActing copies;
  AxisAction action;
  AxisWall wall;
  const char* meaning;  // for whoever runs a scene with it
};

constexpr AxisTraits traits_of(AxisRule axis) {
  switch (axis) {
    case AxisRule::images:
      return {CopiesActing::every, AxisAction::none, AxisWall::none,
              "a grain near the axis meets its own images, as in a vessel whose every sector is the same"};
    case AxisRule::pin:
      return {CopiesActing::beside, AxisAction::pin, AxisWall::none,
              "a grain within 0.05 of its radius of the axis no longer moves sideways; it meets every image of its "
              "neighbours"};
    case AxisRule::line:
      return {CopiesActing::beside, AxisAction::none, AxisWall::line,
              "a rigid, frictional line that no grain's surface passes"};
    case AxisRule::hollow:
      return {CopiesActing::every, AxisAction::none, AxisWall::cylinder,
              "an inner cylinder; in a sector every copy acts"};
    case AxisRule::clamp:
      break;
  }
  return {CopiesActing::beside, AxisAction::clamp, AxisWall::none,
          "a grain whose surface reaches the axis loses its velocity towards it, and does not meet its own images"};
}

/// Does every copy act on every grain?
constexpr bool every_copy_acts(AxisRule axis) { return traits_of(axis).copies == CopiesActing::every; }
/// Does a grain meet its own copies?
constexpr bool meets_itself(AxisRule axis) { return every_copy_acts(axis); }
/// Does a grain that comes to the axis stay there, and meet all copies of the others from then on?
constexpr bool holds_on_axis(AxisAction action) { return action == AxisAction::pin; }
constexpr bool holds_on_axis(AxisRule axis) { return holds_on_axis(traits_of(axis).action); }
/// Is there something of a material around the axis?
constexpr bool is_solid(AxisRule axis) { return traits_of(axis).wall != AxisWall::none; }
/// Is it a cylinder, which needs a radius?
constexpr bool is_cylinder(AxisRule axis) { return traits_of(axis).wall == AxisWall::cylinder; }
/// Would a grain on the axis stand at the place of its own copies, and meet them there?
constexpr bool needs_way_to_axis(AxisRule axis) { return meets_itself(axis) && !is_solid(axis); }

/// A grain closer to the axis than this part of its diameter has no radial direction.
inline constexpr double axis_resolution = 1e-9;

/// Whether a grain at (x, y) [m] is on the axis for a rule that holds it there: closer than 0.05 of its radius (Cui
/// et al. 2007). For one grain, or for a pack of them.
template <class Real>
inline auto on_axis(const Real& x, const Real& y, const Real& radius) {
  return x * x + y * y < 0.0025 * radius * radius;
}
/// Whether this rule holds a grain at (x, y) on the axis: it meets every copy of others, and its own copies nobody.
inline bool held_on_axis(AxisRule axis, double x, double y, double radius) {
  return holds_on_axis(axis) && on_axis(x, y, radius);
}

}  // namespace wedge
