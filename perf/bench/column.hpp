// column.hpp: the column of grains that the benchmarks run: hopper grains in a flat-bottomed cylinder.
#pragma once

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "kernels/fill.hpp"
#include "kernels/laws/friction.hpp"
#include "kernels/time_step.hpp"

namespace wedge {

inline constexpr double column_dt = 2.26e-5;         // s, the paper's
inline constexpr double column_diameter = 0.005;     // m, of a grain
inline constexpr double column_vessel_radius = 0.1;  // m

/// What the grains of the column have in common; `sizes`: the material, `kinds`: nothing. They differ by less than
/// changes a contact, so that loops for different grains compute the same bed.
enum class Grains { alike, sizes, kinds };

struct ColumnOptions {
  long particles = 32000;  // of the whole vessel
  Friction friction = Friction::rolling;
  int order = 1;  // the vessel is cut into so many sectors
  Precision precision = Precision::double_precision;
  bool energy_budget = true;
  Grains grains = Grains::alike;
};

inline Scene column_scene(const ColumnOptions& options) {
  constexpr double pi = 3.14159265358979;
  constexpr int wall_material = 1;
  Scene s;
  s.domain.order = options.order;
  s.domain.kind = options.order > 1 ? DomainKind::sector : DomainKind::full;
  s.materials = {{"grain", 3800, 1e7, 0.3}, {"wall", 3800, 1e7, 0.3}};
  if (options.grains == Grains::kinds) s.materials.push_back({"twin", 3800, 1e7, 0.3});
  const int kinds = static_cast<int>(s.materials.size());
  s.interactions = PairTable<Interaction>(kinds);
  for (int a = 0; a < kinds; ++a) {
    for (int b = 0; b <= a; ++b) {
      if (a == wall_material && b == wall_material) continue;
      Interaction& c = s.interactions(a, b);
      if (options.friction != Friction::none) c.sliding = a == wall_material || b == wall_material ? 0.5 : 0.6;
      if (options.friction == Friction::rolling) c.rolling = 0.02 * column_diameter;
      c.damping_normal = c.damping_tangential = 0.3;
    }
  }
  const double d = column_diameter, radius = column_vessel_radius;
  const double height =
      static_cast<double>(options.particles) * (pi / 6) * d * d * d / (0.27 * pi * radius * radius);
  WallDescription wall;
  wall.name = "vessel";
  wall.profile = {{0, 0}, {radius, 0}, {radius, 3 * height + 1}};
  wall.material = wall_material;
  s.walls = {wall};
  RandomFill fill;
  fill.sizes = std::vector<SizeClass>{{d, 1, 0}};
  fill.count = options.particles;
  fill.r_high = radius;
  fill.z_high = height + d;
  fill.speed = 0.05;
  s.particles.grains = fill;
  s.output.energy_budget = options.energy_budget;
  s.run.precision = options.precision;
  return s;
}

/// Grains at rest at the places of a file, lines "x y z" [m]. Each second one is of the other material where there
/// are two, each third one is smaller where sizes differ.
inline void read_places(State& state, const Scene& scene, const std::string& path, Grains grains) {
  std::ifstream file(path);
  std::vector<Vec3> places;
  if (!file) throw std::runtime_error("cannot read " + path);
  for (Vec3 x; file >> x.x >> x.y >> x.z;) places.push_back(x);
  Particles& p = state.particles;
  p.resize(static_cast<Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    p.position.set(i, places[i]);
    p.velocity.set(i, {});
    p.angular_velocity.set(i, {});
    p.radius[i] = 0.5 * column_diameter * (grains != Grains::alike && i % 3 == 0 ? 1 - 1e-5 : 1);
    p.material[i] = grains == Grains::kinds && i % 2 == 0 ? 2 : 0;
    p.id[i] = static_cast<std::int32_t>(i);
  }
  complete_grains(p, scene.materials, column_diameter);
}

inline void write_places(const State& state, const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) throw std::runtime_error("cannot write " + path);
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.particles.count()); ++i) {
    const Vec3 x = state.particles.position.get(i);
    std::fprintf(file, "%.12g %.12g %.12g\n", x.x, x.y, x.z);
  }
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path);
}

/// The column before its first step: at the places of the file `start`, or filled at random where that is empty.
inline State column_state(const Scene& scene, const std::string& start, Grains grains = Grains::alike) {
  State state = make_domain(scene);
  if (start.empty())
    fill_at_random(state, scene, std::get<RandomFill>(scene.particles.grains));
  else
    read_places(state, scene, start, grains);
  describe_grains(state);
  return state;
}

/// Starts the column and runs it until `seconds` of simulated time have passed.
inline void settle(const Scene& scene, State& state, double seconds) {
  TimeStep step(scene, state);
  step.start(state, column_dt);
  while (state.time < seconds) step.advance(state, column_dt);
}

}  // namespace wedge
