// warnings.cpp: what is doubtful in a scene but not wrong.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/time_scales.hpp"
#include "io/scene/checks.hpp"
#include "io/scene/gaps.hpp"
#include "io/scene/scene_file.hpp"

namespace wedge {

namespace {

using Warnings = std::vector<std::string>;

void doubt_step(const Scene& scene, double step, const std::string& where, Warnings& warnings) {
  const bool hertzian = is_hertzian(scene.contact.law);
  const StepScale scale = step_scale(scene);
  if (scale.time > 0 && step > scale.doubtful)
    warnings.push_back(
        where + " of " + short_number(step) + " s is " + short_number(100 * step / scale.time) + " % of the " +
        scale.name + " time, " + short_number(scale.time) + " s" +
        (hertzian && damping_shortens(scene) > 1
             ? ", with a damping ratio of " + short_number(largest_damping(scene))
             : "") +
        ": such a step may heat a bed, which then never comes to rest; watch the residual in energies.csv");
  const double impact = hertzian ? collision_time(scene, 1.0) : 0;
  if (impact > 0 && impact < 10 * step)
    warnings.push_back("with " + where + " of " + short_number(step) + " s a collision at 1 m/s lasts only " +
                       short_number(impact / step) + " steps; check that results do not depend on it");
}

/// Whether the segment from p to q has a part strictly inside the box (Liang, Barsky, ACM TOG 3 (1984) 1-22).
bool enters_box(Eigen::Vector2d p, Eigen::Vector2d q, Eigen::Vector2d low, Eigen::Vector2d high) {
  double begin = 0, end = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double step = q[axis] - p[axis];
    if (step == 0) {
      if (p[axis] <= low[axis] || p[axis] >= high[axis]) return false;
      continue;
    }
    const double first = (low[axis] - p[axis]) / step, second = (high[axis] - p[axis]) / step;
    begin = std::max(begin, std::min(first, second));
    end = std::min(end, std::max(first, second));
  }
  return begin < end;
}

void doubt_fill(const Scene& scene, Warnings& warnings) {
  const auto* fill = std::get_if<RandomFill>(&scene.particles.grains);
  if (!fill) return;
  if (fill->count % scene.domain.order != 0)
    warnings.push_back("count = " + std::to_string(fill->count) + " is not divisible by " +
                       std::to_string(scene.domain.order) + ": the sector takes " +
                       std::to_string(fill->count / scene.domain.order) + " grains");
  const double slack = 1e-9;
  const Eigen::Vector2d low(fill->r_low + slack, fill->z_low + slack),
      high(fill->r_high - slack, fill->z_high - slack);
  for (const WallDescription& wall : scene.walls) {
    for (std::size_t i = 0; wall.present && i + 1 < wall.profile.size(); ++i) {
      if (!enters_box(wall.profile[i], wall.profile[i + 1], low, high)) continue;
      warnings.push_back("the wall '" + wall.name + "' passes through the fill region");
      break;
    }
  }
}

/// Below an arc of 4 d at the wall a sector is thin everywhere: Yang et al. (2014), Ind. Eng. Chem. Res. 53, 8245,
/// find its coordination number too low wherever the arc r theta is shorter than that.
void doubt_thickness(const Scene& scene, Warnings& warnings) {
  constexpr double least_arc = 4;  // mean diameters
  const double diameter = mean_diameter(scene.particles), radius = widest_radius(scene);
  if (scene.domain.kind != DomainKind::sector || !(diameter > 0 && radius > 0)) return;
  const double circle = 2 * numbers::pi * radius / diameter, arc = circle / scene.domain.order;
  if (arc >= least_arc) return;
  const double order = std::max(1.0, std::floor(circle / least_arc));
  warnings.push_back(
      "the sector is thin: at the largest radius, " + short_number(radius) + " m, its arc is " +
      short_number(std::round(100 * arc) / 100) +
      " d long; below 4 d coordination numbers come out too low everywhere; use an angle of at least " +
      plain_number(360 / order) + " degrees");
}

void doubt_pairs(const Scene& scene, Warnings& warnings) {
  for (int a = 0; a < scene.interactions.kinds(); ++a) {
    for (int b = a; b < scene.interactions.kinds(); ++b) {
      const Interaction& pair = scene.interactions(a, b);
      const std::string name = scene.materials[static_cast<std::size_t>(a)].name + "-" +
                               scene.materials[static_cast<std::size_t>(b)].name;
      if (pair.rolling > 0 && scene.contact.rolling == RollingModel::none)
        warnings.push_back("the rolling friction of '" + name +
                           "' has no effect: [contact] has rolling = \"none\"");
      if (std::max(pair.damping_normal, pair.damping_tangential) >= 1)
        warnings.push_back("the damping of '" + name +
                           "' is critical or above: grains would not bounce but creep apart");
    }
  }
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  Warnings warnings;
  doubt_step(scene, chosen_time_step(scene), "the time step", warnings);
  for (const Stage& stage : scene.stages)
    if (stage.time_step)
      doubt_step(scene, *stage.time_step, "the time step of stage '" + stage.name + "'", warnings);
  for (std::string& gap : wall_gaps(scene)) warnings.push_back(std::move(gap));
  doubt_thickness(scene, warnings);
  doubt_fill(scene, warnings);
  doubt_pairs(scene, warnings);
  for (const Stage& stage : scene.stages)
    if (stage.at_most <= 0 && !std::holds_alternative<UntilTime>(stage.until))
      warnings.push_back("the stage '" + stage.name + "' may never end: give it at_most = seconds");
  return warnings;
}

}  // namespace wedge
