// scene_run.hpp: a scene file run without files: its stages one after the other, and what must hold in any scene.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "apps/setup/setup.hpp"
#include "io/scene/scene_file.hpp"
#include "kernels/passes/measure.hpp"
#include "kernels/time_step.hpp"
#include "tests/support/catch.hpp"

namespace wedge::test {

inline Scene hard_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return read_scene(std::string(WEDGE_SOURCE_DIR) + "/tests/scenarios/hard_cases/" + name + ".toml", overrides);
}

class SceneRun {
public:
  explicit SceneRun(const Scene& scene)
      : scene_(scene),
        state(make_start(scene)),
        step(scene, state),
        dt(stage_time_step(scene, state, scene.stages[0])) {
    step.start(state, dt);
    begin = step.energies(state);
  }

  void run(double seconds) {
    for (std::int64_t k = std::llround(seconds / dt); k > 0; --k) step.advance(state, dt);
  }
  void run_steps(std::int64_t steps) {
    for (std::int64_t k = 0; k < steps; ++k) step.advance(state, dt);
  }
  void open(const char* wall) { step.change_walls(state, {state.vessel.wall_index(wall)}, {}); }

  bool finite() const {
    const Particles& p = state.particles;
    for (const Vec3Array* field : {&p.position, &p.velocity, &p.angular_velocity})
      for (const Array<double>* component : {&field->x, &field->y, &field->z})
        for (Index i = 0; i < p.count(); ++i)
          if (!std::isfinite((*component)[static_cast<std::size_t>(i)])) return false;
    return true;
  }
  /// Nothing is lost, nothing is not a number, no grain is outside.
  void check_sound() const {
    CHECK(state.put_in == state.particles.count() + state.taken_out);
    CHECK(finite());
    int outside = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(state.particles.count()); ++i)
      outside += state.vessel.beside(state.particles.position.get(i), 0) ? 1 : 0;
    CHECK(outside == 0);
  }
  /// Energy lost so far [J].
  double dissipated() const {
    const EnergyLedger& l = state.energy;
    return l.normal_damping + l.tangential_damping + l.sliding + l.rolling + l.axis;
  }
  double residual() const { return wedge::residual(state.energy, begin, step.energies(state)); }
  /// The residual as a part of what was dissipated.
  double unexplained() const { return std::fabs(residual()) / dissipated(); }
  double deepest_overlap() const {  // m
    double deepest = 0;
    for (Index k = 0; k < state.contacts.rows(); ++k)
      deepest = std::max(deepest, row_overlap(state, static_cast<std::size_t>(k)));
    return deepest;
  }
  double largest_spin() const {
    double most = 0;
    for (Index i = 0; i < state.particles.count(); ++i)
      most = std::max(most, norm(state.particles.angular_velocity.get(static_cast<std::size_t>(i))));
    return most;
  }
  double mean_height() const {
    double sum = 0;
    for (Index i = 0; i < state.particles.count(); ++i)
      sum += state.particles.position.z[static_cast<std::size_t>(i)];
    return sum / state.particles.count();
  }
  double weight() const {  // N
    double mass = 0;
    for (Index i = 0; i < state.particles.count(); ++i) mass += state.particles.mass[static_cast<std::size_t>(i)];
    return mass * scene_.domain.gravity.norm();
  }
  double load() const {  // N, downwards on all walls
    double sum = 0;
    for (const WallLoad& wall : wall_loads(state)) sum -= wall.force.z;
    return sum;
  }

private:
  Scene scene_;

public:
  State state;
  TimeStep step;
  double dt;
  Energies begin;
};

}  // namespace wedge::test
