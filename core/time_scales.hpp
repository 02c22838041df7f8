// time_scales.hpp: the times a step must resolve: the Rayleigh time of a sphere, the time two grains touch.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grain_sizes.hpp"
#include "core/particles.hpp"
#include "core/restitution.hpp"
#include "core/scene.hpp"

namespace wedge {

namespace numbers {
constexpr double pi = 3.14159265358979323846;
}

/// Time [s] a Rayleigh wave takes along a sphere: pi R sqrt(rho/G) / (0.1631 nu + 0.8766), G = E/(2(1+nu)).
/// Li, Xu, Thornton, Powder Technology 160 (2005) 219-228; Thornton, Randall, Micromechanics of Granular
/// Materials (1988) 133-142.
inline double rayleigh_time(double radius, const Material& m) {
  const double shear_modulus = m.young / (2 * (1 + m.poisson));
  return numbers::pi * radius * std::sqrt(m.density / shear_modulus) / (0.1631 * m.poisson + 0.8766);
}

/// Smallest Rayleigh time [s] of the grains of a scene; 0 when their sizes are not known.
inline double rayleigh_time(const Scene& scene) {
  const double d = smallest_diameter(scene.particles);
  if (!(d > 0)) return 0;
  const auto shortest = [&](double diameter, int material) {
    return rayleigh_time(diameter / 2, scene.materials[static_cast<std::size_t>(material)]);
  };
  if (const auto* fill = std::get_if<RandomFill>(&scene.particles.grains)) {
    if (const auto* classes = std::get_if<std::vector<SizeClass>>(&fill->sizes)) {
      double time = std::numeric_limits<double>::infinity();
      for (const SizeClass& c : *classes) time = std::min(time, shortest(c.diameter, c.material));
      return time;
    }
  }
  return shortest(d, *grain_materials(scene.particles).begin());
}

/// Time [s] two equal elastic spheres touch that meet at `speed` [m/s]: 2.9432 a/v, largest approach
/// a = (15 m* v^2 / (16 E* sqrt(R*)))^(2/5), m*, R*, E* half of mass, radius, E/(1-nu^2). Timoshenko, Goodier,
/// Theory of Elasticity (1970), section 142.
inline double collision_time(double radius, const Material& m, double speed) {
  const double reduced_mass = sphere_mass(radius, m.density) / 2;
  const double reduced_modulus = m.young / (2 * (1 - m.poisson * m.poisson));
  const double approach =
      std::pow(15.0 / 16.0 * reduced_mass * speed * speed / (reduced_modulus * std::sqrt(radius / 2)), 2.0 / 5.0);
  return 2.9432 * approach / speed;
}

/// Shortest collision time [s] of two equal grains of a scene that meet at `speed` [m/s]; 0 when sizes are not
/// known.
inline double collision_time(const Scene& scene, double speed) {
  const double d = smallest_diameter(scene.particles);
  if (!(d > 0)) return 0;
  double time = std::numeric_limits<double>::infinity();
  for (int material : grain_materials(scene.particles))
    time = std::min(time, collision_time(d / 2, scene.materials[static_cast<std::size_t>(material)], speed));
  return time;
}

/// Time [s] the two lightest grains of a scene touch where it gives the stiffness: pi sqrt(m*/k_n), m* half the
/// mass of one; 0 when not known.
inline double given_contact_time(const Scene& scene) {
  if (scene.contact.contact_time > 0) return scene.contact.contact_time;
  const double d = smallest_diameter(scene.particles);
  if (!(d > 0 && scene.contact.normal_stiffness > 0)) return 0;
  double mass = std::numeric_limits<double>::infinity();
  for (int material : grain_materials(scene.particles))
    mass = std::min(mass, sphere_mass(d / 2, scene.materials[static_cast<std::size_t>(material)].density));
  return numbers::pi * std::sqrt(mass / 2 / scene.contact.normal_stiffness);
}

/// Largest damping ratio of the pairs of a scene, given or following from a restitution.
inline double largest_damping(const Scene& scene) {
  double largest = 0;
  for (const Interaction& pair : scene.interactions.entries())
    largest = std::max(largest, pair.restitution
                                    ? damping_for(scene.contact.law, scene.contact.tension, *pair.restitution)
                                    : std::max(pair.damping_normal, pair.damping_tangential));
  return largest;
}

/// By how much a step must be shorter than that of a weakly damped scene: the damping ratio over 0.3, at least 1.
/// Beds with a ratio of 0.6 heat at half the step at which those with 0.3 do (perf/speed_error/speed_error.md).
inline double damping_shortens(const Scene& scene) { return std::max(1.0, largest_damping(scene) / 0.3); }

/// The part of the Rayleigh time that "auto" takes.
inline double automatic_part(const Scene& scene) { return 0.1 / damping_shortens(scene); }

/// The time that limits the step of a scene, and how long steps may be [s].
struct StepScale {
  const char* name;  // of the time
  double time;       // s; 0: not known
  double automatic;  // what "auto" takes
  double doubtful;   // from which on a bed may be heated
  double refused;    // from which on it is no simulation
};
/// The smallest Rayleigh time, or the contact time where the scene gives the stiffness, of which 1/50 is usual:
/// Luding, European Journal of Environmental and Civil Engineering 12 (2008) 785-826. From 25 % of
/// the Rayleigh time on a bed may never come to rest (tests/README.md, "Hard cases").
inline StepScale step_scale(const Scene& scene) {
  if (stiffness_is_given(scene.contact.law)) {
    const double time = given_contact_time(scene);
    return {"contact", time, time / 50, 1.0 / 20.0 * time, 1.0 / 5.0 * time};
  }
  const double time = rayleigh_time(scene);
  return {"Rayleigh", time, automatic_part(scene) * time, 20.0 / 100.0 / damping_shortens(scene) * time,
          40.0 / 100.0 * time};
}

/// Time step [s] of a scene: the one it gives, or, for "auto", the automatic one.
inline double chosen_time_step(const Scene& scene) {
  return scene.time_step > 0 ? scene.time_step : step_scale(scene).automatic;
}

}  // namespace wedge
