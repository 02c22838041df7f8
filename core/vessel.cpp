// vessel.cpp: from wall profiles to features, and the nearest point of a feature.
#include "core/vessel.hpp"

#include <algorithm>
#include <cmath>

#include "core/require.hpp"
#include "core/symmetry.hpp"

namespace wedge {
namespace {

constexpr double join_distance = 1e-9;  // m: closer ends of profiles are one edge

}  // namespace

Vessel::Vessel(const Scene& scene) : slot_(scene.domain.kind == DomainKind::slot), walls_(scene.walls) {
  for (int w = 0; w < wall_count(); ++w) add_profile(w);
  join_edges();
  add_core(scene.domain);
  frictionless_from_ = wall_count();
  if (scene.domain.kind != DomainKind::full && scene.domain.sides != Sides::periodic) {
    add_side_planes(scene.domain);
    if (scene.domain.sides == Sides::rigid) frictionless_from_ = wall_count();
  }
  travel_.assign(walls_.size(), 0.0);
}

void Vessel::add_profile(int w) {
  const auto& points = wall(w).profile;
  require(points.size() >= 2, "a wall profile needs two points");
  for (std::size_t p = 0; p + 1 < points.size(); ++p) {
    WallFeature segment;
    segment.wall = w;
    segment.start = points[p];
    segment.length = (points[p + 1] - points[p]).norm();
    require(segment.length > 0, "a wall segment needs a length");
    segment.direction = (points[p + 1] - points[p]) / segment.length;
    features_.push_back(segment);
  }
}

/// Adds one edge for each end point of a segment; segments that meet in a point (of one wall, or of walls that
/// move alike) share it.
void Vessel::join_edges() {
  const int segments = feature_count();
  for (int s = 0; s < segments; ++s) {
    for (const bool at_end : {false, true}) {
      const WallFeature& segment = features_[static_cast<std::size_t>(s)];
      const Eigen::Vector2d point = segment.start + (at_end ? segment.length : 0.0) * segment.direction;
      const double speed = wall(segment.wall).speed;
      const auto shared = std::find_if(features_.begin() + segments, features_.end(), [&](const WallFeature& e) {
        return (e.start - point).norm() < join_distance && wall(e.wall).speed == speed;
      });
      int edge = static_cast<int>(shared - features_.begin());
      if (shared == features_.end()) {
        WallFeature e;
        e.kind = WallFeature::Kind::edge;
        e.wall = segment.wall;
        e.start = point;
        edge = feature_count();
        features_.push_back(e);
      }
      features_[static_cast<std::size_t>(edge)].neighbours.push_back(s);
      features_[static_cast<std::size_t>(s)].neighbours.push_back(edge);
    }
  }
}

void Vessel::add_side_planes(const Domain& domain) {
  const auto add = [&](const char* name, Vec3 normal, double offset) {
    WallDescription side;
    side.name = name;
    side.material = walls_.empty() ? 0 : walls_.front().material;
    WallFeature plane;
    plane.kind = WallFeature::Kind::plane;
    plane.wall = wall_count();
    plane.plane_normal = normal;
    plane.plane_offset = offset;
    walls_.push_back(side);
    features_.push_back(plane);
  };
  add("side at start", {0, 1, 0}, 0);
  if (domain.kind == DomainKind::slot) {
    add("side at end", {0, -1, 0}, -domain.slot_width);
  } else {
    add("side at end", Symmetry::rotation(domain.order).turn_vector({0, -1, 0}, 1), 0);
  }
}

/// The line or the inner cylinder that the axis rule puts in.
void Vessel::add_core(const Domain& domain) {
  const AxisWall around = wall_around_axis(domain);
  if (around == AxisWall::none) return;
  WallDescription wall;
  wall.name = around == AxisWall::line ? "axis line" : "inner cylinder";
  wall.material = domain.axis_material;
  WallFeature core;
  core.kind = WallFeature::Kind::core;
  core.wall = wall_count();
  core.core_radius = cut_out_radius(domain);
  walls_.push_back(wall);
  features_.push_back(core);
}

int Vessel::wall_index(const std::string& name) const {
  for (int w = 0; w < wall_count(); ++w)
    if (wall(w).name == name) return w;
  return -1;
}

void Vessel::advance(double dt) {
  for (std::size_t w = 0; w < walls_.size(); ++w) travel_[w] += walls_[w].speed * dt;
}

double Vessel::fastest_wall() const {
  double fastest = 0;
  for (const auto& w : walls_)
    if (w.present) fastest = std::max(fastest, std::abs(w.speed));
  return fastest;
}

bool Vessel::beside(Vec3 p, double radius) const {
  double widest = 0;
  for (const WallFeature& f : features_)
    if (f.kind == WallFeature::Kind::core && std::hypot(p.x, p.y) < f.core_radius - radius) return true;
  for (const WallDescription& w : walls_)
    for (const Eigen::Vector2d& point : w.profile) widest = std::max(widest, point.x());
  return !slot_ && widest > 0 && std::hypot(p.x, p.y) > widest + radius;
}

Vec3 Vessel::surface_velocity(int w, Vec3 p) const {
  const WallDescription& d = wall(w);
  return {-d.spin * p.y, d.spin * p.x, d.speed};
}

int Vessel::carrier(int f) const {
  const WallFeature& x = feature(f);
  if (present(x.wall)) return x.wall;
  if (x.kind == WallFeature::Kind::edge) {
    for (const int s : x.neighbours)
      if (present(feature(s).wall)) return feature(s).wall;
  }
  return -1;
}

namespace {

/// Nearest place of a plane or of the endless cylinder.
[[gnu::noinline]] WallProximity proximity_of_plane_or_core(const WallFeature& x, Vec3 p) {
  WallProximity result;
  result.minimum = true;
  if (x.kind == WallFeature::Kind::plane) {
    const double height = height_over_plane(x, p);
    result.distance = std::abs(height);
    result.normal = height < 0 ? x.plane_normal : -x.plane_normal;
  } else {
    const double r = std::sqrt(p.x * p.x + p.y * p.y), beyond = beyond_core(x, r);
    result.distance = std::abs(beyond);
    if (r > 0) result.normal = (beyond < 0 ? 1 / r : -1 / r) * Vec3{p.x, p.y, 0};
  }
  return result;
}

}  // namespace

WallProximity Vessel::proximity(int f, Vec3 p) const {
  const WallFeature& x = feature(f);
  WallProximity result;
  if (__builtin_expect(x.kind == WallFeature::Kind::plane || x.kind == WallFeature::Kind::core, 0))
    return proximity_of_plane_or_core(x, p);
  // The half plane through the axis and the point; on the axis itself the one with phi = 0.
  const double r = slot_ ? p.x : std::sqrt(p.x * p.x + p.y * p.y);
  const Vec3 outward = slot_ || r == 0 ? Vec3{1, 0, 0} : Vec3{p.x / r, p.y / r, 0};
  const double z = p.z - travel(x.wall);
  const WayToProfile<double> way = way_to_profile(x, r, z);
  if (x.kind == WallFeature::Kind::segment) {
    result.minimum = way.arc > 0 && way.arc < x.length;
  } else {
    result.minimum = true;
    for (const int n : x.neighbours) {  // an edge counts where no segment that meets it comes closer
      const WallFeature& segment = feature(n);
      if (!present(segment.wall)) continue;
      const double s = way_to_profile(segment, r, z).arc;
      const bool edge_is_start = (segment.start - x.start).squaredNorm() < join_distance * join_distance;
      if (edge_is_start ? s > 0 : s < segment.length) result.minimum = false;
    }
  }
  result.distance = way.distance;
  if (result.distance > 0) {
    const double toward = way.u / result.distance;
    result.normal = {toward * outward.x, toward * outward.y, way.z / result.distance};
  }
  return result;
}

}  // namespace wedge
