// meet_walls.cpp: grains and the wall features near them.
#include "kernels/passes/meet_walls.hpp"

#include <algorithm>
#include <sstream>

#include "core/require.hpp"

namespace wedge {
namespace {

bool contains(const std::vector<int>& features, int feature) {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

/// Whether a grain can roll from feature a on to feature b: they meet, or an edge lies between them.
bool beside(const Vessel& vessel, int a, int b) {
  const std::vector<int>&of_a = vessel.feature(a).neighbours, &of_b = vessel.feature(b).neighbours;
  return contains(of_b, a) || std::any_of(of_a.begin(), of_a.end(), [&](int edge) { return contains(of_b, edge); });
}

WallMeeting meet(State& state, std::size_t i, std::size_t k) {
  WallContactTable& c = state.wall_contacts;
  const double radius = state.particles.radius[i];
  const WallProximity near = state.vessel.proximity(c.feature[k], state.particles.position.get(i));
  const bool was = c.touching[k] != 0;
  const bool is = near.minimum && near.distance < radius && state.vessel.active(c.feature[k]);
  c.overlap[k] = is ? radius - near.distance : 0.0;
  return {was ? (is ? Touch::held : Touch::left) : (is ? Touch::fresh : Touch::apart), near.normal};
}

/// Row k, which is fresh, takes over from a row that the grain has just left, if there is one.
void take_over(State& state, std::size_t k, std::size_t begin, const std::vector<WallMeeting>& met, bool couples) {
  WallContactTable& c = state.wall_contacts;
  for (std::size_t m = 0; m < met.size(); ++m) {
    const std::size_t o = begin + m;
    if (met[m].touch != Touch::left || !beside(state.vessel, c.feature[o], c.feature[k])) continue;
    c.history.set(k, c.history.get(o));
    c.normal.set(k, c.normal.get(o));
    if (couples) c.rolling_moment.set(k, c.rolling_moment.get(o));
    return;
  }
}

}  // namespace

void meet_walls(State& state, Index i, Index begin, Index end, bool couples, std::vector<WallMeeting>& met) {
  const auto first = static_cast<std::size_t>(begin), last = static_cast<std::size_t>(end);
  met.resize(last - first);
  bool some_fresh = false;
  for (std::size_t k = first; k < last; ++k) {
    met[k - first] = meet(state, static_cast<std::size_t>(i), k);
    some_fresh = some_fresh || met[k - first].touch == Touch::fresh;
  }
  if (!some_fresh) return;
  for (std::size_t k = first; k < last; ++k)
    if (met[k - first].touch == Touch::fresh) take_over(state, k, first, met, couples);
}

void report_crossing(const State& state, Index i) {
  const auto s = static_cast<std::size_t>(i);
  const Vec3 x = state.particles.position.get(s);
  std::ostringstream text;
  text << "grain " << state.particles.id[s] << " went through a wall at (" << x.x << ", " << x.y << ", " << x.z
       << ") m in step " << state.step
       << ". Likely cause: the wall is too soft for the load, or the time step too long.";
  throw PhysicsError(text.str());
}

}  // namespace wedge
