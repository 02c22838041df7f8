// time_step.cpp: the order of the passes.
#include "kernels/time_step.hpp"

#include "core/parallel.hpp"
#include "kernels/fill.hpp"

namespace wedge {
namespace {

constexpr double default_skin = 0.02;  // mean diameters, of a pair at rest (perf/README.md, "Margins")

}  // namespace

TimeStep::TimeStep(const Scene& scene, State& state)
    : scene_(scene),
      gravity_{scene.domain.gravity.x(), scene.domain.gravity.y(), scene.domain.gravity.z()},
      list_({scene.domain.axis, false}, 0) {
  state.particles.seen.set_precision(scene.run.precision);
  choose(state);
}

/// Chooses types by what the grains have in common now.
void TimeStep::choose(State& state) {
  const Friction friction = needed_friction(scene_);
  const bool uniform = state.alike && state.particles.count() > 0;
  const double skin = scene_.run.skin > 0 ? scene_.run.skin : default_skin * state.mean_diameter;
  bodies_ = make_body_passes(scene_, state, friction, uniform);
  law_ = choose_law_passes(scene_, state, friction, uniform);
  list_ = NeighbourList({scene_.domain.axis, has_couples(friction)}, 0.5 * skin);
}

int TimeStep::advance(State& state, double dt, int most) {
  for (int step = 1;; ++step) {
    const auto& move = step == 1 ? bodies_.first_half : bodies_.second_and_first_half;
    const bool left = stopwatch_.time("move grains", [&] { return move(state, sums_, dt); });
    state.vessel.advance(dt);
    state.wall_travel += state.vessel.fastest_wall() * dt;
    state.time += dt;
    ++state.step;
    const std::int64_t taken_out = state.taken_out;
    if (left || state.list_expired || state.wall_travel > state.wall_margin) {
      stopwatch_.time("neighbour list", [&] { renew_list(state, dt); });
    } else {
      stopwatch_.time("refresh images", [&] { list_.refresh(state); });
    }
    forces(state, dt);
    if (step < most && state.taken_out == taken_out) continue;
    stopwatch_.time("move grains", [&] { return bodies_.second_half(state, sums_, dt); });
    return step;
  }
}

void TimeStep::forces(State& state, double dt) {
  const ReactionMap& map = list_.reactions(state);
  stopwatch_.time("evaluate contacts", [&] { law_.evaluate_contacts(state, map, sums_, dt); });
  stopwatch_.time("fold reactions", [&] { fold_reactions(state, map, sums_); });
  stopwatch_.time("evaluate walls", [&] { law_.evaluate_walls(state, sums_, dt); });
}

void TimeStep::renew_list(State& state, double dt) {
  check_motion(state, dt);
  discharge(state);
  list_.renew(state, dt);
}

/// Takes out the grains that have passed the outlet.
void TimeStep::discharge(State& state) {
  if (!scene_.domain.outlet_height) return;
  const double outlet = *scene_.domain.outlet_height;
  const std::vector<Index> leaving = grains_below(state, outlet);
  if (leaving.empty()) return;
  for (const Index i : leaving) departures_.push_back(departure_of(state, i, outlet));
  list_.refresh(state);  // the energy of contacts is that of the places of now
  book_removal(state, leaving, law_, gravity_);
  list_.remove(state, leaving);
}

void TimeStep::start(State& state, double dt) {
  Particles& p = state.particles;
  show_grains(p, 0);
  renew_list(state, dt);
  forces(state, 0);
  for_each(p.count(), [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    p.force.set(s, sums_.force(i));
    p.torque.set(s, sums_.torque(i));
    p.rolling_cap[s] = sums_.rolling_cap(i);
  });
}

void TimeStep::insert(State& state, const std::vector<NewGrain>& grains) {
  const Index before = state.particles.count();
  list_.insert(state, grains);
  book_insertion(state, before, gravity_);
  if (state.mean_diameter == 0) describe_grains(state);  // the first grains of an empty vessel
  choose(state);
}

void TimeStep::change_walls(State& state, const std::vector<int>& remove, const std::vector<int>& add) const {
  if (remove.empty() && add.empty()) return;
  const ElasticEnergy before = law_.elastic_energy(state, {});
  for (const int w : remove) state.vessel.set_present(w, false);
  for (const int w : add) state.vessel.set_present(w, true);
  const ElasticEnergy after = law_.elastic_energy(state, {});
  state.energy.carried_out += before.normal + before.tangential - after.normal - after.tangential;
  state.energy.elastic_tangential_removed += before.tangential - after.tangential;
  NeighbourList::expire(state);
}

}  // namespace wedge
