// vessel.hpp: the walls as a flat list of features: segments (cylinder, cone, disc, annulus), circular edges,
// planes, and an endless cylinder around the axis.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/scene.hpp"
#include "core/vec3.hpp"

namespace wedge {

/// One piece of wall. In the half plane (u, z), u is the distance r from the axis, or x in a slot.
struct WallFeature {
  enum class Kind { segment, edge, plane, core };
  Kind kind = Kind::segment;
  int wall = 0;                     // index of the wall it belongs to
  Eigen::Vector2d start{0, 0};      // m, segment: first end; edge: the point
  Eigen::Vector2d direction{1, 0};  // segment: unit vector along it
  double length = 0;                // m, segment
  std::vector<int> neighbours;      // features that meet this one: edges of a segment, segments of an edge
  Vec3 plane_normal;                // plane through the axis (or y = const): unit vector into the domain
  double plane_offset = 0;          // m: plane is dot(x, plane_normal) = plane_offset
  double core_radius = 0;           // m: endless cylinder around z; 0: the axis itself as a line
};

/// The way from a point of the half plane to the nearest point of a segment, or of an edge, which is one of no
/// length. For one point, or for a pack of them.
template <class Real>
struct WayToProfile {
  Real arc;             // m: where along the segment the point projects, not cut at its ends
  Real u, z, distance;  // m
};
/// From the point (u, z) [m] of the wall as it was drawn: z is less what the wall has travelled.
template <class Real>
inline WayToProfile<Real> way_to_profile(const WallFeature& f, const Real& u, const Real& z) {
  using std::max, std::min, std::sqrt;
  WayToProfile<Real> way;
  way.arc = (u - f.start.x()) * f.direction.x() + (z - f.start.y()) * f.direction.y();
  const Real along = max(Real(0.0), min(Real(f.length), way.arc));
  way.u = f.start.x() + along * f.direction.x() - u;
  way.z = f.start.y() + along * f.direction.y() - z;
  way.distance = sqrt(way.u * way.u + way.z * way.z);
  return way;
}
/// Signed distance [m] of a point from a plane, and from the endless cylinder at its distance r [m] from the axis.
template <class Real>
inline Real height_over_plane(const WallFeature& f, const Vector3<Real>& p) {
  return p.x * f.plane_normal.x + p.y * f.plane_normal.y + p.z * f.plane_normal.z - f.plane_offset;
}
template <class Real>
inline Real beyond_core(const WallFeature& f, const Real& r) {
  return r - f.core_radius;
}

/// Where a wall feature is nearest to a point.
struct WallProximity {
  double distance = 0;   // m, from the point to the feature
  Vec3 normal;           // unit vector from the point to the feature
  bool minimum = false;  // the distance has a local minimum there: a touching grain has a contact
};

/// The walls of a scene with their state: which are present, how far moving ones have travelled.
class Vessel {
public:
  Vessel() = default;
  /// Pre: every profile has at least two points, neighbours distinct. Side planes come from scene.domain.
  explicit Vessel(const Scene& scene);

  bool slot() const { return slot_; }
  int wall_count() const { return static_cast<int>(walls_.size()); }
  const WallDescription& wall(int w) const { return walls_[static_cast<std::size_t>(w)]; }
  int wall_index(const std::string& name) const;  // -1: no such wall
  bool present(int w) const { return walls_[static_cast<std::size_t>(w)].present; }
  void set_present(int w, bool present) { walls_[static_cast<std::size_t>(w)].present = present; }
  bool frictionless(int w) const { return w >= frictionless_from_; }

  double travel(int w) const { return travel_[static_cast<std::size_t>(w)]; }  // m upwards since the start
  void set_travel(int w, double metres) { travel_[static_cast<std::size_t>(w)] = metres; }
  void advance(double dt);
  /// Largest |speed| of a wall [m/s].
  double fastest_wall() const;
  /// Whether p, the centre of a grain of this radius, is outside the widest wall, where nothing holds it, or within
  /// the inner cylinder. False without walls and in a slot.
  bool beside(Vec3 p, double radius) const;
  /// Velocity [m/s] of wall w at point p.
  Vec3 surface_velocity(int w, Vec3 p) const;

  int feature_count() const { return static_cast<int>(features_.size()); }
  const WallFeature& feature(int f) const { return features_[static_cast<std::size_t>(f)]; }
  /// Wall that carries feature f now: for an edge that several walls share, the first that is present.
  int carrier(int f) const;
  bool active(int f) const { return carrier(f) >= 0; }
  WallProximity proximity(int f, Vec3 p) const;

private:
  void add_profile(int w);
  void add_side_planes(const Domain& domain);
  void add_core(const Domain& domain);
  void join_edges();

  bool slot_ = false;
  int frictionless_from_ = 0;
  std::vector<WallDescription> walls_;
  std::vector<double> travel_;
  std::vector<WallFeature> features_;
};

}  // namespace wedge
