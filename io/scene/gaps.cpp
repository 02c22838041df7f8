// gaps.cpp: walls that nearly join, and vessels that do not hold their grains.
#include "io/scene/gaps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/grain_sizes.hpp"
#include "io/scene/diagnostics.hpp"

namespace wedge {

namespace {

using Point = Eigen::Vector2d;       // (r, z), in a slot (x, z)
constexpr double same_point = 1e-9;  // m: closer points are one, as in core/vessel.cpp
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Walls that are present in each stage.
std::vector<std::vector<const WallDescription*>> walls_by_stage(const Scene& scene) {
  std::vector<const WallDescription*> present;
  for (const WallDescription& wall : scene.walls)
    if (wall.present) present.push_back(&wall);
  std::vector<std::vector<const WallDescription*>> stages;
  for (const Stage& stage : scene.stages) {
    const auto named = [](const std::vector<std::string>& names, const WallDescription& wall) {
      return std::find(names.begin(), names.end(), wall.name) != names.end();
    };
    present.erase(std::remove_if(present.begin(), present.end(),
                                 [&](const WallDescription* wall) { return named(stage.remove, *wall); }),
                  present.end());
    for (const WallDescription& wall : scene.walls)
      if (named(stage.add, wall)) present.push_back(&wall);
    stages.push_back(present);
  }
  return stages;
}

/// The point of a profile nearest to p.
Point nearest_point(const std::vector<Point>& profile, const Point& p) {
  Point nearest = profile.front();
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Point along = profile[i + 1] - profile[i];
    const double share = std::clamp((p - profile[i]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    const Point candidate = profile[i] + share * along;
    if ((candidate - p).norm() < (nearest - p).norm()) nearest = candidate;
  }
  return nearest;
}

/// An opening between a point of one wall and the nearest one of another, or of its own on the axis' other side.
struct Gap {
  const WallDescription* wall = nullptr;
  const WallDescription* other = nullptr;  // nullptr: the axis
  Point here{0, 0}, there{0, 0};
  double width = infinite;  // m; at the axis the diameter of the hole
};

std::string point_text(const Point& p) { return "(" + short_number(p.x()) + ", " + short_number(p.y()) + ")"; }

std::string width_text(double width, double diameter) {
  return short_number(width) + " m (" + short_number(std::round(1000 * width / diameter) / 1000) + " d)";
}

bool told_before(const std::vector<Gap>& gaps, const Gap& gap, double diameter) {
  return std::any_of(gaps.begin(), gaps.end(), [&](const Gap& g) {
    const bool same_walls =
        (g.wall == gap.wall && g.other == gap.other) || (g.wall == gap.other && g.other == gap.wall);
    return same_walls && (0.5 * (g.here + g.there) - 0.5 * (gap.here + gap.there)).norm() < diameter;
  });
}

/// The narrowest gap between an end of `wall` and the others, or the axis; nothing when the end touches a wall.
std::optional<Gap> gap_at_end(const std::vector<const WallDescription*>& walls, const WallDescription& wall,
                              bool at_back, bool slot) {
  const auto& profile = wall.profile;
  const Point end = at_back ? profile.back() : profile.front();
  const Point before = at_back ? profile[profile.size() - 2] : profile[1];
  if ((profile.front() - profile.back()).norm() <= same_point) return {};
  Gap gap{&wall, nullptr, end, end, infinite};
  for (const WallDescription* other : walls) {
    if (other == &wall) continue;
    const Point there = nearest_point(other->profile, end);
    const double width = (there - end).norm();
    if (width <= same_point) return {};
    const bool fixed_together = other->speed == wall.speed && other->spin == wall.spin;
    if (fixed_together && width < gap.width) gap = {&wall, other, end, there, width};
  }
  const bool towards_axis = !slot && end.x() < before.x();
  if (towards_axis && 2 * end.x() < gap.width) gap = {&wall, nullptr, end, {0, end.y()}, 2 * end.x()};
  return gap.width > same_point ? std::optional<Gap>(gap) : std::nullopt;
}

std::vector<std::string> doubt_joints(const Scene& scene, double diameter) {
  std::vector<Gap> gaps;
  for (const auto& walls : walls_by_stage(scene)) {
    for (const WallDescription* wall : walls) {
      for (const bool at_back : {false, true}) {
        const auto gap = gap_at_end(walls, *wall, at_back, scene.domain.kind == DomainKind::slot);
        if (gap && gap->width < diameter && !told_before(gaps, *gap, diameter)) gaps.push_back(*gap);
      }
    }
  }
  std::vector<std::string> warnings;
  for (const Gap& gap : gaps) {
    if (gap.other)
      warnings.push_back("the walls '" + gap.wall->name + "' and '" + gap.other->name + "' nearly join: they are " +
                         width_text(gap.width, diameter) + " apart, from " + point_text(gap.here) + " to " +
                         point_text(gap.there) + " m; write the same point in both profiles if they should join");
    else
      warnings.push_back("the wall '" + gap.wall->name + "' ends at " + point_text(gap.here) +
                         " m and leaves a hole at the axis " + width_text(gap.width, diameter) +
                         " wide, which no grain passes; write r = 0 there if it should be closed");
  }
  return warnings;
}

// ---- whether a vessel holds its grains

struct Interval {
  double low = 0, high = 0;
  bool enclosed = false;  // walls stand, or stood a little higher, at both sides: grains there may fill it
};
using Intervals = std::vector<Interval>;

/// Where the centre of a grain of this radius at height z would overlap a piece of wall.
std::optional<Interval> covered(const Point& p, const Point& q, double radius, double z) {
  double low = infinite, high = -infinite;
  const auto include = [&](double u) {
    low = std::min(low, u);
    high = std::max(high, u);
  };
  for (const Point& end : {p, q}) {
    const double height = z - end.y();
    if (std::abs(height) >= radius) continue;
    const double half = std::sqrt(radius * radius - height * height);
    include(end.x() - half);
    include(end.x() + half);
  }
  const Point along = q - p, aside = radius / along.norm() * Point(-along.y(), along.x());
  for (const double side : {1.0, -1.0}) {
    const double share = (z - p.y() - side * aside.y()) / along.y();  // not a number in a level piece: no crossing
    if (share >= 0 && share <= 1) include(p.x() + side * aside.x() + share * along.x());
  }
  return low < high ? std::optional<Interval>(Interval{low, high, false}) : std::nullopt;
}

/// What is left of a row: where a grain's centre can be at height z.
Intervals free_at(const std::vector<const WallDescription*>& walls, double radius, double z, bool slot) {
  Intervals blocked;
  for (const WallDescription* wall : walls)
    for (std::size_t i = 0; i + 1 < wall->profile.size(); ++i)
      if (const auto piece = covered(wall->profile[i], wall->profile[i + 1], radius, z)) blocked.push_back(*piece);
  std::sort(blocked.begin(), blocked.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  Intervals left;
  const double begin = slot ? -infinite : 0;
  double from = begin;
  for (const Interval& b : blocked) {
    if (b.low > from) left.push_back({from, b.low, !slot || from > begin});
    from = std::max(from, b.high);
  }
  left.push_back({from, infinite, false});
  return left;
}

/// The same places with no two intervals of one kind that overlap: a vessel with inclined walls would otherwise add
/// one in each row. What holds for either of two that overlap holds for both: they lie in the same gap of a row.
Intervals merged(Intervals intervals) {
  std::sort(intervals.begin(), intervals.end(), [](const Interval& a, const Interval& b) {
    return a.enclosed != b.enclosed ? a.enclosed < b.enclosed : a.low < b.low;
  });
  Intervals apart;
  for (const Interval& i : intervals) {
    if (apart.empty() || apart.back().enclosed != i.enclosed || i.low > apart.back().high) {
      apart.push_back(i);
    } else {
      apart.back().high = std::max(apart.back().high, i.high);
    }
  }
  return apart;
}

/// Whether grains of this radius can get from the fill region to the outside without ever rising: they fall,
/// spread between walls, and roll from where they land.
bool leaks(const std::vector<const WallDescription*>& walls, const RandomFill& fill, double radius, double diameter,
           bool slot) {
  double lowest = fill.z_low;
  for (const WallDescription* wall : walls)
    for (const Point& point : wall->profile) lowest = std::min(lowest, point.y());
  const double top = fill.z_high - diameter / 2, bottom = lowest - radius;
  const double step = std::max({diameter / 50, radius / 25, (top - bottom) / 20000});
  const double inset = fill.r_low > 0 || slot ? diameter / 2 : 0;
  const Interval start{fill.r_low + inset, fill.r_high - diameter / 2, false};
  Intervals reached;
  for (double z = top; z > bottom - step; z -= step) {
    const Intervals open = free_at(walls, radius, z, slot);
    Intervals next;
    for (const Interval& from : reached) {
      bool lands = true;  // some of it, on a wall below
      for (const Interval& to : open) {
        const double low = std::max(from.low, to.low), high = std::min(from.high, to.high);
        if (low > high) continue;
        if (low == from.low && high == from.high) lands = false;
        if (!to.enclosed && from.enclosed) return true;
        next.push_back(to.enclosed ? to : Interval{low, high, false});
      }
      if (lands && !from.enclosed) return true;  // it rolls off into the open
    }
    if (z >= fill.z_low + diameter / 2) {
      for (const Interval& to : open) {
        const double low = std::max(start.low, to.low), high = std::min(start.high, to.high);
        if (low <= high) next.push_back(to.enclosed ? to : Interval{low, high, false});
      }
    }
    reached = merged(std::move(next));
    if (reached.empty() && z < fill.z_low) return false;
  }
  return !reached.empty();
}

/// The narrowest place that lets the largest grain out which still gets out; nothing when walls do not narrow it.
std::optional<Gap> bottleneck(const std::vector<const WallDescription*>& walls, const RandomFill& fill,
                              double diameter, bool slot) {
  double widest = diameter;
  for (const WallDescription* wall : walls)
    for (const Point& point : wall->profile) widest = std::max(widest, 2 * point.norm());
  double passes = diameter, stops = 2 * widest;
  if (leaks(walls, fill, stops / 2, diameter, slot)) return {};
  // 40 halvings: enough for any vessel on Earth; one of 1e300 m would never come down to a hundredth of a grain.
  for (int halvings = 0; halvings < 40 && stops - passes > 0.01 * diameter; ++halvings) {
    const double middle = 0.5 * (passes + stops);
    (leaks(walls, fill, middle / 2, diameter, slot) ? passes : stops) = middle;
  }
  Gap best;
  const auto consider = [&](const Gap& gap) {
    if (std::abs(gap.width - passes) < std::abs(best.width - passes)) best = gap;
  };
  for (const WallDescription* wall : walls) {
    for (const Point& here : wall->profile) {
      if (!slot) consider({wall, nullptr, here, {0, here.y()}, 2 * here.x()});
      for (const WallDescription* other : walls) {
        const Point there = nearest_point(other->profile, here);
        if (other != wall) consider({wall, other, here, there, (there - here).norm()});
      }
    }
  }
  return std::abs(best.width - passes) < 0.2 * diameter ? std::optional<Gap>(best) : std::nullopt;
}

std::string leak_text(const std::optional<Gap>& gap, const std::string& stage, double diameter) {
  const std::string begin = "in the stage '" + stage + "' grains can get out of the vessel ";
  if (!gap) return begin + "past its walls, which do not close it below and at the side";
  const std::string where = point_text(gap->here) + " m";
  if (!gap->other)
    return begin + "through the hole inside the wall '" + gap->wall->name + "' at " + where + ", " +
           width_text(gap->width, diameter) + " wide";
  return begin + "between the wall '" + gap->wall->name + "' at " + where + " and the wall '" + gap->other->name +
         "' at " + point_text(gap->there) + " m, a gap " + width_text(gap->width, diameter) + " wide";
}

/// Without an outlet no stage may leak; with one, the stages before the first that removes a wall.
std::vector<std::string> doubt_vessel(const Scene& scene, double diameter) {
  const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
  const Eigen::Vector3d& g = scene.domain.gravity;
  const bool falls = g.x() == 0 && g.y() == 0 && g.z() < 0;
  if (!fill || !falls || !scene.start_from.empty()) return {};
  if (!(fill->r_high - fill->r_low >= diameter && fill->z_high - fill->z_low >= diameter)) return {};
  const bool slot = scene.domain.kind == DomainKind::slot;
  const auto stages = walls_by_stage(scene);
  std::size_t closed = scene.stages.size();  // so many stages are to hold the grains
  if (scene.domain.outlet_height) {
    const auto opens = std::find_if(scene.stages.begin(), scene.stages.end(),
                                    [](const Stage& stage) { return !stage.remove.empty(); });
    closed = opens == scene.stages.end() ? 0 : static_cast<std::size_t>(opens - scene.stages.begin());
  }
  for (std::size_t s = 0; s < closed; ++s) {
    if (!leaks(stages[s], *fill, 0.4995 * diameter, diameter, slot)) continue;
    const std::string where =
        leak_text(bottleneck(stages[s], *fill, diameter, slot), scene.stages[s].name, diameter);
    if (!scene.domain.outlet_height)
      return {where +
              ", and no outlet takes them: they fall for ever; close it, or add outlet = { z = ... } to "
              "[domain]"};
    return {where + ", before the stage '" + scene.stages[closed].name +
            "' opens it; close it, by a wall that a later stage removes if need be"};
  }
  return {};
}

}  // namespace

std::vector<std::string> wall_gaps(const Scene& scene) {
  const double diameter = smallest_diameter(scene.particles);
  if (!(diameter > 0)) return {};
  std::vector<std::string> warnings = doubt_joints(scene, diameter);
  for (std::string& warning : doubt_vessel(scene, diameter)) warnings.push_back(std::move(warning));
  return warnings;
}

}  // namespace wedge
