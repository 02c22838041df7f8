// scene_warnings.cpp: what is doubtful in a scene but not wrong.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "core/time_scales.hpp"
#include "io/scene_checks.hpp"
#include "io/scene_file.hpp"

namespace wedge {

namespace {

using Warnings = std::vector<std::string>;

void doubt_step(const Scene& scene, double step, const std::string& where, Warnings& warnings) {
  const bool linear = scene.contact.law == ContactLaw::linear;
  const double scale = linear ? linear_contact_time(scene) : rayleigh_time(scene);
  if (scale > 0 && step > (linear ? doubtful_linear_step : doubtful_step) * scale)
    warnings.push_back(where + " of " + short_number(step) + " s is " + short_number(100 * step / scale) +
                       " % of the " + (linear ? "contact" : "Rayleigh") + " time, " + short_number(scale) +
                       " s; check that results do not depend on it");
  const double impact = linear ? 0 : collision_time(scene, 1.0);
  if (impact > 0 && impact < 10 * step)
    warnings.push_back("with " + where + " of " + short_number(step) + " s a collision at 1 m/s lasts only " +
                       short_number(impact / step) + " steps; check that results do not depend on it");
}

/// Ends of walls that miss another wall's vertex by a little: grains would meet two edges where one was meant.
void doubt_joints(const Scene& scene, Warnings& warnings) {
  const double near = 0.1 * mean_diameter(scene.particles), same = 1e-9;
  for (std::size_t a = 0; a < scene.walls.size(); ++a) {
    for (std::size_t b = 0; b < scene.walls.size(); ++b) {
      if (a == b) continue;
      const auto& ends = scene.walls[a].profile;
      const auto& others = scene.walls[b].profile;
      for (const Eigen::Vector2d& end : {ends.front(), ends.back()}) {
        for (const Eigen::Vector2d& other : others) {
          const bool other_is_end = &other == &others.front() || &other == &others.back();
          if (other_is_end && a > b) continue;  // told from the other side
          const double gap = (end - other).norm();
          if (gap > same && gap < near)
            warnings.push_back("the walls '" + scene.walls[a].name + "' and '" + scene.walls[b].name +
                               "' nearly join: they are " + short_number(gap) + " m apart at (" +
                               short_number(end.x()) + ", " + short_number(end.y()) + ")");
        }
      }
    }
  }
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
    warnings.push_back("count = " + std::to_string(fill->count) + " does not divide by " +
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
  doubt_joints(scene, warnings);
  doubt_fill(scene, warnings);
  doubt_pairs(scene, warnings);
  for (const Stage& stage : scene.stages)
    if (stage.at_most <= 0 && !std::holds_alternative<UntilTime>(stage.until))
      warnings.push_back("the stage '" + stage.name + "' may never end: give it at_most = seconds");
  const auto* file = std::get_if<StateFile>(&scene.particles.grains);
  if (file && !std::filesystem::exists(file->path))
    warnings.push_back("the file of grains '" + file->path + "' does not exist");
  if (!scene.start_from.empty() && !std::filesystem::exists(scene.start_from))
    warnings.push_back("the run or checkpoint to start from, '" + scene.start_from + "', does not exist");
  return warnings;
}

}  // namespace wedge
