// time_step.cpp: the order of the passes.
#include "kernels/time_step.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "kernels/laws/hertz_mindlin.hpp"
#include "kernels/laws/linear_law.hpp"
#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "kernels/laws/total_coulomb.hpp"
#include "kernels/passes/evaluate_contacts.hpp"

namespace wedge {

extern template LawPasses make_law_passes<MindlinDeresiewicz>(const Scene&, const State&, Friction, bool);
extern template LawPasses make_law_passes<HertzMindlin>(const Scene&, const State&, Friction, bool);
extern template LawPasses make_law_passes<LinearLaw>(const Scene&, const State&, Friction, bool);
extern template LawPasses make_law_passes<TotalCoulomb<MindlinDeresiewicz>>(const Scene&, const State&, Friction,
                                                                            bool);
extern template LawPasses make_law_passes<TotalCoulomb<HertzMindlin>>(const Scene&, const State&, Friction, bool);
extern template LawPasses make_law_passes<TotalCoulomb<LinearLaw>>(const Scene&, const State&, Friction, bool);

namespace {

/// The least of friction that the scene's contacts need.
Friction needed_friction(const Scene& scene) {
  bool slides = false, rolls = false;
  for (const Interaction& pair : scene.interactions.entries()) {
    slides = slides || pair.sliding > 0;
    rolls = rolls || pair.rolling > 0;
  }
  if (rolls && scene.contact.rolling == RollingModel::elastic_plastic_spring) return Friction::spring;
  if (rolls && scene.contact.rolling == RollingModel::constant_torque)
    return scene.contact.rolling_velocity == RollingVelocity::relative ? Friction::relative : Friction::rolling;
  return slides ? Friction::sliding : Friction::none;
}

template <class Law>
LawPasses limited(const Scene& scene, const State& state, Friction friction, bool uniform) {
  if (scene.contact.coulomb == Coulomb::total)
    return make_law_passes<TotalCoulomb<Law>>(scene, state, friction, uniform);
  return make_law_passes<Law>(scene, state, friction, uniform);
}

LawPasses law_passes(const Scene& scene, const State& state, Friction friction, bool uniform) {
  switch (scene.contact.law) {
    case ContactLaw::hertz_mindlin:
      return limited<HertzMindlin>(scene, state, friction, uniform);
    case ContactLaw::linear:
      return limited<LinearLaw>(scene, state, friction, uniform);
    case ContactLaw::mindlin_deresiewicz:
      break;
  }
  return limited<MindlinDeresiewicz>(scene, state, friction, uniform);
}

constexpr double default_skin = 0.02;  // mean diameters, of a pair at rest (perf/README.md, "Margins")

}  // namespace

TimeStep::TimeStep(const Scene& scene, State& state) : domain_(scene.domain) {
  state.particles.seen.set_precision(scene.run.precision);
  const Friction friction = needed_friction(scene);
  const bool uniform = state.alike && state.particles.count() > 0;
  const double skin = scene.run.skin > 0 ? scene.run.skin : default_skin * state.mean_diameter;
  smallest_margin_ = 0.5 * skin;
  rules_ = {scene.domain.axis, has_couples(friction)};
  bodies_ = make_body_passes(scene, state, friction, uniform);
  law_ = law_passes(scene, state, friction, uniform);
}

int TimeStep::advance(State& state, double dt, int most) {
  for (int step = 1;; ++step) {
    const auto& move = step == 1 ? bodies_.first_half : bodies_.second_and_first_half;
    const bool left = stopwatch_.time("move grains", [&] { return move(state, reactions_, dt); });
    state.vessel.advance(dt);
    state.wall_travel += state.vessel.fastest_wall() * dt;
    state.time += dt;
    ++state.step;
    const std::int64_t taken_out = state.taken_out;
    if (left || state.wall_travel > state.wall_margin) {
      stopwatch_.time("neighbour list", [&] { renew_list(state, dt); });
    } else {
      stopwatch_.time("refresh images", [&] { refresh_images(state); });
    }
    forces(state, dt);
    if (step < most && state.taken_out == taken_out) continue;
    stopwatch_.time("move grains", [&] { return bodies_.second_half(state, reactions_, dt); });
    return step;
  }
}

void TimeStep::forces(State& state, double dt) {
  if (reactions_.list != state.list_builds)  // it came from a checkpoint
    map_reactions(state, rules_.axis, reactions_);
  stopwatch_.time("evaluate contacts", [&] { law_.evaluate_contacts(state, reactions_, dt); });
  stopwatch_.time("fold reactions", [&] { fold_reactions(state, reactions_); });
  stopwatch_.time("evaluate walls", [&] { law_.evaluate_walls(state, reactions_, dt); });
}

void TimeStep::renew_list(State& state, double dt) {
  check_motion(state, dt);
  if (domain_.outlet_height && mark_departures(state, scratch_, *domain_.outlet_height) > 0) {
    refresh_images(state);  // the energy of contacts is that of the places of now
    book_departures(state);
  }
  set_contacts_aside(state, scratch_);
  wrap(state, scratch_);
  choose_margins(state, smallest_margin_, dt);
  sort_by_cell(state, scratch_);
  make_images(state, rules_.axis);
  find_contacts(state, scratch_, rules_);
  find_wall_contacts(state, scratch_);
  ++state.list_builds;
  map_reactions(state, rules_.axis, reactions_);
}

void TimeStep::start(State& state, double dt) {
  Particles& p = state.particles;
  for (Index i = 0; i < p.count(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    p.seen.set(s, {p.position.get(s), p.radius[s], p.velocity.get(s), p.mass[s], p.angular_velocity.get(s),
                   static_cast<double>(p.material[s])});
  }
  renew_list(state, dt);
  forces(state, 0);
  for_each(p.count(), [&](Index i) {
    const auto s = static_cast<std::size_t>(i);
    p.force.set(s, reactions_.force(i));
    p.torque.set(s, reactions_.torque(i));
    p.rolling_cap[s] = reactions_.rolling_cap(i);
  });
}

void TimeStep::expire_list(State& state) { state.wall_travel = std::numeric_limits<double>::infinity(); }

void TimeStep::change_walls(State& state, const std::vector<int>& remove, const std::vector<int>& add) const {
  if (remove.empty() && add.empty()) return;
  const ElasticEnergy before = law_.elastic_energy(state, {});
  for (const int w : remove) state.vessel.set_present(w, false);
  for (const int w : add) state.vessel.set_present(w, true);
  const ElasticEnergy after = law_.elastic_energy(state, {});
  state.energy.carried_out += before.normal + before.tangential - after.normal - after.tangential;
  state.energy.elastic_tangential_removed += before.tangential - after.tangential;
  expire_list(state);
}

/// Books the energy that leaving grains take along: their own, and what is stored in contacts with them.
void TimeStep::book_departures(State& state) {
  const Particles& p = state.particles;
  const Vec3 g{domain_.gravity.x(), domain_.gravity.y(), domain_.gravity.z()};
  for (Index i = 0; i < p.count(); ++i) {
    const auto s = static_cast<std::size_t>(i);
    if (!scratch_.leaves[s]) continue;
    const Seen seen = p.seen.get(s);
    const Vec3 v = seen.velocity, w = seen.angular_velocity;
    state.energy.carried_out += 0.5 * p.mass[s] * dot(v, v) +
                                0.5 * sphere_inertia(p.mass[s], p.radius[s]) * dot(w, w) -
                                p.mass[s] * dot(g, p.position.get(s));
  }
  const ElasticEnergy stored =
      law_.elastic_energy(state, [&](Index i) { return scratch_.leaves[static_cast<std::size_t>(i)] != 0; });
  state.energy.carried_out += stored.normal + stored.tangential;
  state.energy.elastic_tangential_removed += stored.tangential;
}

Energies TimeStep::energies(const State& state) const {
  const Particles& p = state.particles;
  const Vec3 g{domain_.gravity.x(), domain_.gravity.y(), domain_.gravity.z()};
  Energies e = reduce_blocks(
      p.count(), Energies{},
      [&](Index begin, Index end) {
        Energies sum;
        for (Index i = begin; i < end; ++i) {
          const auto s = static_cast<std::size_t>(i);
          const Vec3 v = p.velocity.get(s), w = p.angular_velocity.get(s);
          sum.kinetic += 0.5 * p.mass[s] * dot(v, v);
          sum.rotational += 0.5 * sphere_inertia(p.mass[s], p.radius[s]) * dot(w, w);
          sum.potential -= p.mass[s] * dot(g, p.position.get(s));
        }
        return sum;
      },
      [](Energies a, const Energies& b) {
        a.kinetic += b.kinetic;
        a.rotational += b.rotational;
        a.potential += b.potential;
        return a;
      });
  const ElasticEnergy stored = law_.elastic_energy(state, {});
  e.elastic_normal = stored.normal;
  e.elastic_tangential = stored.tangential;
  return e;
}

double TimeStep::history_coupling(const State& state, const Energies& start, const Energies& now) const {
  const EnergyLedger& l = state.energy;
  return now.elastic_tangential + l.elastic_tangential_removed - start.elastic_tangential - l.tangential_work +
         l.sliding;
}

double TimeStep::residual(const State& state, const Energies& start, const Energies& now) const {
  const EnergyLedger& l = state.energy;
  return now.total() - start.total() - l.carried_in + l.carried_out - l.wall_work -
         history_coupling(state, start, now) + l.normal_damping + l.tangential_damping + l.sliding + l.rolling +
         l.axis;
}

EnergyBudget TimeStep::budget(const State& state, const Energies& start) const {
  const EnergyLedger& l = state.energy;
  const Energies now = energies(state);
  const double given = start.potential - now.potential + l.carried_in - l.carried_out + l.wall_work;
  return {start.total() - start.potential + std::max(given, 0.0),
          l.normal_damping + l.tangential_damping + l.sliding + l.rolling + l.axis, residual(state, start, now)};
}

}  // namespace wedge
