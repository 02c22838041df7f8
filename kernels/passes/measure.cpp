// measure.cpp: loads, momentum, energy per grain, the state's hash.
#include "kernels/passes/measure.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/checksum.hpp"
#include "core/parallel.hpp"

namespace wedge {

std::vector<WallLoad> wall_loads(const State& state) {
  const WallContactTable& w = state.wall_contacts;
  std::vector<WallLoad> loads(static_cast<std::size_t>(state.vessel.wall_count()));
  for (std::size_t g = 0; g < w.grain.size(); ++g) {
    const auto i = static_cast<std::size_t>(w.grain[g]);
    for (auto k = static_cast<std::size_t>(w.begin[g]); k < static_cast<std::size_t>(w.begin[g + 1]); ++k) {
      const int wall = w.touching[k] ? state.vessel.carrier(w.feature[k]) : -1;
      if (wall < 0) continue;
      WallLoad& load = loads[static_cast<std::size_t>(wall)];
      load.force -= w.force.get(k);
      load.torque -= cross(state.particles.position.get(i), w.force.get(k)) + w.torque.get(k);
    }
  }
  return loads;
}

Vec3 momentum(const State& state) {
  const Particles& p = state.particles;
  return reduce_blocks(
      p.count(), Vec3{},
      [&](Index begin, Index end) {
        Vec3 sum;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
          sum += p.mass[i] * p.velocity.get(i);
        return sum;
      },
      [](Vec3 a, const Vec3& b) { return a + b; });
}

double mean_kinetic_energy(const State& state) {
  const Particles& p = state.particles;
  const double sum = reduce_blocks(
      p.count(), 0.0,
      [&](Index begin, Index end) {
        double e = 0;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
          const Vec3 v = p.velocity.get(i), w = p.angular_velocity.get(i);
          e += 0.5 * p.mass[i] * dot(v, v) + 0.5 * sphere_inertia(p.mass[i], p.radius[i]) * dot(w, w);
        }
        return e;
      },
      [](double a, double b) { return a + b; });
  return p.count() > 0 ? sum / p.count() : 0;
}

std::uint64_t state_hash(const State& state) {
  const Particles& p = state.particles;
  const ContactTable& c = state.contacts;
  std::uint64_t hash = fnv_start;
  const auto mix = [&](const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) {
      unsigned char bytes[sizeof x];  // lowest first, as the processors have them that wedge runs on
      std::memcpy(bytes, &x, sizeof x);
      hash = fnv1a(hash, bytes, sizeof x);
    }
  };
  std::vector<std::size_t> order(static_cast<std::size_t>(p.count()));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p.id[a] < p.id[b]; });
  for (const std::size_t i : order) {
    mix(p.position.get(i));
    mix(p.velocity.get(i));
    mix(p.angular_velocity.get(i));
    for (auto k = static_cast<std::size_t>(c.row_begin[i]); k < static_cast<std::size_t>(c.row_begin[i + 1]); ++k)
      if (row_overlap(state, k) > 0) mix(c.history.get(k));
  }
  return hash;
}

}  // namespace wedge
