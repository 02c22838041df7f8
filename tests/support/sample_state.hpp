// sample_state.hpp: a small state in which no two numbers are equal, for tests of files.
#pragma once

#include <cmath>

#include "core/state.hpp"

namespace wedge {

/// Numbers that need all their digits; the k-th one is the same every time.
class SampleNumbers {
public:
  double operator()() { return std::sin(1.0 + 0.7 * ++k_) / 3.0; }

private:
  int k_ = 0;
};

/// Fills an array with fresh numbers (0, 1, 2, ... from `start` where it holds whole numbers).
template <class T>
void fill_sample(Array<T>& array, SampleNumbers& next, int start) {
  for (std::size_t i = 0; i < array.size(); ++i) {
    if constexpr (std::is_same_v<T, double>)
      array[i] = next();
    else
      array[i] = static_cast<T>(start + static_cast<int>(i));
  }
}

/// A scene with a cone, a lid that is absent, and a quarter-turn sector.
inline Scene sample_scene() {
  Scene scene;
  scene.domain.kind = DomainKind::sector;
  scene.domain.order = 4;
  WallDescription cone;
  cone.name = "cone";
  cone.profile = {{0.05, 0.0}, {0.2, 0.3}, {0.2, 0.5}};
  WallDescription lid;
  lid.name = "lid";
  lid.profile = {{0.0, 0.0}, {0.05, 0.0}};
  lid.present = false;
  scene.walls = {cone, lid};
  return scene;
}

/// `grains` grains with two images, three near pairs (the middle one apart, the last one across the seam) and three
/// wall rows. Pre: grains >= 3.
inline State sample_state(Index grains = 5) {
  State s;
  s.symmetry = Symmetry::rotation(4);
  s.vessel = Vessel(sample_scene());
  SampleNumbers next;
  s.particles.resize(grains);
  int start = 3;
  Particles::for_each_field(s.particles,
                            [&](const FieldInfo&, auto& field) { fill_sample(field, next, start += 100); });
  for (double& r : s.particles.radius) r = 0.01 + std::abs(r);
  for (double& m : s.particles.mass) m = 0.01 + std::abs(m);
  const auto slots = static_cast<std::size_t>(grains) + 2;
  s.images.owner = {0, 2};
  s.images.turn = {1, -1};
  s.particles.position.resize(slots);
  s.particles.seen.resize(slots);
  s.particles.radius.resize(slots);
  s.particles.mass.resize(slots);
  s.particles.material.resize(slots);
  for (std::size_t i = slots - 2; i < slots; ++i) {
    s.particles.position.set(i, {next(), next(), next()});
    s.particles.radius[i] = next();
    s.particles.mass[i] = next();
    s.particles.material[i] = static_cast<int>(i);
  }
  s.contacts.resize(3);
  ContactTable::for_each_field(s.contacts,
                               [&](const FieldInfo&, auto& field) { fill_sample(field, next, start += 100); });
  s.contacts.first = {0, 0, 1};
  s.contacts.second = {1, 2, grains + 1};
  s.contacts.row_begin.assign(static_cast<std::size_t>(grains) + 1, 3);
  s.contacts.row_begin[0] = 0;
  s.contacts.row_begin[1] = 2;
  for (std::size_t i = 0; i < slots; ++i)
    s.particles.seen.set(
        i, {{next(), next(), next()}, next(), {next(), next(), next()}, next(), {next(), next(), next()}, next()});
  // Places and sizes that make of the rows a contact, a gap and a contact.
  const auto copy = static_cast<std::size_t>(grains) + 1;
  const auto put = [&](std::size_t i, Vec3 x, double radius) {
    s.particles.position.set(i, x);
    s.particles.radius[i] = radius;
  };
  put(0, {0.21, 0.33, 0.7}, 0.05);
  put(1, {0.27, 0.33, 0.78}, 0.0501);
  put(2, {0.21, 0.5, 0.7}, 0.04);
  put(copy, {0.27, 0.26, 0.83}, 0.036);
  s.wall_contacts.resize(3);
  WallContactTable::for_each_field(s.wall_contacts,
                                   [&](const FieldInfo&, auto& field) { fill_sample(field, next, start += 100); });
  s.wall_contacts.feature = {0, 3, 2};
  s.wall_contacts.touching = {1, 0, 1};
  s.wall_contacts.grain = {1, 2};
  s.wall_contacts.begin = {0, 1, 3};
  EnergyLedger::for_each_field(s.energy, [&](const char*, double& value) { value = next(); });
  s.vessel.set_present(0, false);
  s.vessel.set_present(1, true);
  s.vessel.set_travel(1, next());
  s.time = next();
  s.wall_margin = next();
  s.wall_travel = next();
  s.history_ahead = next();
  s.step = 12345678901;
  s.list_builds = 17;
  s.mean_diameter = next();
  s.alike = true;
  s.put_in = 23;
  s.taken_out = 29;
  s.next_id = 31;
  s.list_expired = true;
  return s;
}

/// Forces for the rows of a state, no two numbers equal.
inline Vec3Array sample_forces(const State& s) {
  SampleNumbers next;
  Vec3Array forces;
  forces.resize(s.contacts.first.size());
  for (std::size_t k = 0; k < forces.size(); ++k) forces.set(k, {next(), next(), next()});
  return forces;
}

}  // namespace wedge
