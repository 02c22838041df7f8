// experiment.hpp: small experiments in a few lines: a scene in code, grains by hand, a run for a time.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "kernels/fill.hpp"
#include "kernels/time_step.hpp"

namespace wedge::test {

inline constexpr double pi = 3.14159265358979323846;

/// A scene with one material (index 0), no gravity, no walls, no rolling friction.
inline Scene plain_scene(double young, double poisson, double density, double sliding = 0, double damping = 0) {
  Scene s;
  s.materials = {{"grain", density, young, poisson}};
  s.interactions = PairTable<Interaction>(1);
  s.interactions(0, 0).sliding = sliding;
  s.interactions(0, 0).damping_normal = s.interactions(0, 0).damping_tangential = damping;
  s.domain.gravity = Eigen::Vector3d::Zero();
  return s;
}

/// The hopper's and the sandpile's grains of Yang et al. 2014, Tables 1 and 2.
inline Scene hopper_material(double damping = 0.3) {
  Scene s = plain_scene(1e7, 0.3, 3800, 0.6, damping);
  s.interactions(0, 0).rolling = 0.02 * 0.005;
  return s;
}
inline Scene pile_material(double damping = 0.3) {
  Scene s = plain_scene(1e7, 0.3, 2500, 0.6, damping);
  s.interactions(0, 0).rolling = 1e-4;
  return s;
}

inline void add_wall(Scene& s, const char* name, std::vector<Eigen::Vector2d> profile, int material = 0) {
  WallDescription w;
  w.name = name;
  w.profile = std::move(profile);
  w.material = material;
  s.walls.push_back(w);
}
inline void make_sector(Scene& s, int order, AxisRule axis) {
  s.domain.kind = DomainKind::sector;
  s.domain.order = order;
  s.domain.axis = axis;
}

struct Grain {
  double radius;
  Vec3 x, v, w;
  int material = 0;
};

inline State make_state(const Scene& scene, const std::vector<Grain>& grains) {
  State state = make_domain(scene);
  Particles& p = state.particles;
  p.resize(static_cast<Index>(grains.size()));
  Particles::for_each_field(p, [](const FieldInfo&, auto& field) { std::fill(field.begin(), field.end(), 0); });
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Grain& g = grains[i];
    p.position.set(i, g.x);
    p.velocity.set(i, g.v);
    p.angular_velocity.set(i, g.w);
    p.radius[i] = g.radius;
    p.material[i] = g.material;
    p.mass[i] = sphere_mass(g.radius, scene.materials[static_cast<std::size_t>(g.material)].density);
    p.id[i] = static_cast<std::int32_t>(i);
  }
  describe_grains(state);
  state.put_in = p.count();
  return state;
}

/// A scene, its state and the step, ready to run. Grains are looked up by id, whatever the order in memory.
class Experiment {
public:
  Experiment(const Scene& scene, const std::vector<Grain>& grains, double dt)
      : state(make_state(scene, grains)), step(scene, state), dt_(dt) {
    step.start(state, dt);
    begin = step.energies(state);
  }

  void run(int steps) {
    for (int k = 0; k < steps; ++k) step.advance(state, dt_);
  }
  /// Runs until done() holds after a step, or `most` steps.
  bool run_until(const std::function<bool()>& done, int most) {
    for (int k = 0; k < most; ++k) {
      step.advance(state, dt_);
      if (done()) return true;
    }
    return false;
  }
  std::size_t slot(int id) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.particles.count()); ++i)
      if (state.particles.id[i] == id) return i;
    throw std::out_of_range("no grain with this id");
  }
  Vec3 x(int id) const { return state.particles.position.get(slot(id)); }
  Vec3 v(int id) const { return state.particles.velocity.get(slot(id)); }
  Vec3 w(int id) const { return state.particles.angular_velocity.get(slot(id)); }
  double mass(int id) const { return state.particles.mass[slot(id)]; }
  /// Contacts of grains that touch, as the list has them.
  int touching() const {
    int n = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k)
      n += row_overlap(state, k) > 0;
    return n;
  }
  double deepest_overlap() const {
    double deepest = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k)
      deepest = std::max(deepest, row_overlap(state, k));
    return deepest;
  }
  int touching_walls() const {
    int n = 0;
    for (const auto t : state.wall_contacts.touching) n += t;
    return n;
  }
  /// Force on the first grain of a row in the last force step [N].
  Vec3 contact_force(std::size_t row) const { return step.contact_forces(state).get(row); }
  double residual() const { return wedge::residual(state.energy, begin, step.energies(state)); }

  State state;
  TimeStep step;
  Energies begin;

private:
  double dt_;
};

}  // namespace wedge::test
