// departures.cpp: grains below the outlet, and what is recorded of them.
#include "kernels/passes/departures.hpp"

#include <sstream>

#include "core/require.hpp"

namespace wedge {

std::vector<Index> grains_below(const State& state, double outlet) {
  const Particles& p = state.particles;
  std::vector<Index> below;
  for (Index i = 0; i < p.count(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    if (p.position.z[s] >= outlet) continue;
    if (state.vessel.beside(p.position.get(s), p.radius[s])) {
      std::ostringstream text;
      text << "grain " << p.id[s] << " fell outside the vessel, at (" << p.position.x[s] << ", " << p.position.y[s]
           << ", " << p.position.z[s] << ") m in step " << state.step
           << ". Likely cause: walls that do not join, or grains that started outside.";
      throw PhysicsError(text.str());
    }
    below.push_back(i);
  }
  return below;
}

Departure departure_of(const State& state, Index slot, double outlet) {
  const Particles& p = state.particles;
  const auto s = static_cast<std::size_t>(slot);
  const Vec3 x = p.position.get(s), v = p.seen.get(s).velocity;
  return {state.time + (v.z < 0 ? (outlet - x.z) / v.z : 0.0), p.id[s], p.layer[s], x, v, p.mass[s]};
}

}  // namespace wedge
