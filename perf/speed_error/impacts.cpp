// impacts.cpp: oblique impacts of two grains at a given time step against a very fine one.
#include <cmath>
#include <vector>

#include "core/time_scales.hpp"
#include "perf/speed_error/speed_error.hpp"
#include "tests/support/experiment.hpp"

namespace wedge::speed_error {
namespace {

constexpr double fine_step = 0.05;  // % of the Rayleigh time: the reference

struct Rebound {
  double restitution = 0;  // normal velocity after over before
  double spin = 0;         // rad/s
};

/// A grain hits a resting one `angle` [rad] off the line of centres, `phase` of a step after the last one without
/// contact.
Rebound hit(const Scene& scene, double radius, double speed, double angle, double phase, double dt) {
  const double approach = speed * std::cos(angle), side = speed * std::sin(angle);
  const double gap = phase * approach * dt + 1e-12 * radius;
  test::Experiment e(scene,
                     {{radius, {-2 * radius - gap, 0, -phase * side * dt}, {approach, 0, side}, {}},
                      {radius, {0, 0, 0}, {0, 0, 0}, {}}},
                     dt);
  bool touched = false;
  e.run_until(
      [&] {
        const bool now = e.touching() > 0;
        touched = touched || now;
        return touched && !now;
      },
      1000000);
  return {(e.v(1).x - e.v(0).x) / approach, e.w(0).y};
}

/// Mean and its uncertainty of squares, turned into those of the root.
void root_mean_square(const std::vector<double>& squares, double scale, const std::string& name, Result& result) {
  const auto n = static_cast<double>(squares.size());
  double mean = 0, spread = 0;
  for (const double s : squares) mean += s / n;
  for (const double s : squares) spread += (s - mean) * (s - mean) / (n - 1);
  result[name] = std::sqrt(mean) / scale;
  result[name + "_error"] = mean > 0 ? std::sqrt(spread / n) / (2 * std::sqrt(mean)) / scale : 0;
}

}  // namespace

Result impacts(const std::string& scene_name, double step, double speed, Size size) {
  Scene scene = make_scene(scene_name, {}, 1, Size::quick);
  const double rayleigh = rayleigh_time(scene), radius = smallest_diameter(scene.particles) / 2;
  scene.walls.clear();
  scene.domain.gravity.setZero();
  scene.domain.outlet_height.reset();
  const int phases = impact_places(size);
  std::vector<double> restitution, spin;
  double restitution_size = 0, spin_size = 0, count = 0;
  for (const double degrees : {10, 25, 40, 55, 70}) {
    const double angle = degrees * numbers::pi / 180;
    const Rebound truth = hit(scene, radius, speed, angle, 0.5, fine_step / 100 * rayleigh);
    for (int k = 0; k < phases; ++k) {
      const Rebound r = hit(scene, radius, speed, angle, (k + 0.5) / phases, step / 100 * rayleigh);
      restitution.push_back(std::pow(r.restitution - truth.restitution, 2));
      spin.push_back(std::pow(r.spin - truth.spin, 2));
      restitution_size += std::pow(truth.restitution, 2);
      spin_size += std::pow(truth.spin, 2);
      count += 1;
    }
  }
  Result result;
  root_mean_square(restitution, std::sqrt(restitution_size / count), "restitution", result);
  root_mean_square(spin, std::sqrt(spin_size / count), "spin", result);
  result["contact_steps"] = collision_time(radius, scene.materials[0], speed) / (step / 100 * rayleigh);
  return result;
}

}  // namespace wedge::speed_error
