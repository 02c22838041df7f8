// runs.cpp: scenes scaled down, settled and opened; races; drift of trajectories.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "apps/measure/stage_end.hpp"
#include "apps/run/rest.hpp"
#include "apps/setup/setup.hpp"
#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/csv.hpp"
#include "kernels/passes/measure.hpp"
#include "kernels/time_step.hpp"
#include "perf/speed_error/speed_error.hpp"

namespace wedge::speed_error {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
constexpr int look_every = 20;  // steps between looks at rest, as in a run

/// Time [s] this process has computed: other processes on the machine do not count.
double computing_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// A scene on its way.
struct Course {
  explicit Course(Scene s)
      : scene(std::move(s)), state(make_start(scene)), step(scene, state), dt(scene.time_step) {
    step.start(state, dt);
    begin = step.energies(state);
    rest = rest_criterion(scene, state.mean_diameter);
  }
  /// Goes on from a bed of another course, with the laws and lists of `s`.
  Course(Scene s, const Course& from)
      : scene(std::move(s)),
        state(from.state),
        step(scene, state),
        dt(scene.time_step),
        begin(from.begin),
        rest(from.rest) {
    NeighbourList::expire(state);
  }

  void run(double seconds) {
    const double end = state.time + seconds - 0.5 * dt;
    while (state.time < end) some_steps(end);
  }
  /// Runs until the bed has been at rest for as long as the program asks, or `at_most` [s]; whether it came to
  /// rest.
  bool settle(double at_most) {
    const double end = state.time + at_most;
    double quiet_since = -1;
    for (std::size_t out = crossings.size(); state.time < end; out = crossings.size()) {
      some_steps(end);
      const double mass = state.particles.count() > 0 ? state.particles.mass[0] : 0;
      const bool quiet = mean_kinetic_energy(state) < 0.5 * mass * rest.speed * rest.speed;
      if (!quiet || crossings.size() != out)
        quiet_since = -1;
      else if (quiet_since < 0)
        quiet_since = state.time;
      else if (state.time - quiet_since >= rest.duration)
        return true;
    }
    return false;
  }
  void some_steps(double end) {
    const int most = std::clamp(static_cast<int>((end - state.time) / dt) + 1, 1, look_every);
    steps += step.advance(state, dt, most);
    for (const Departure& d : step.take_departures()) crossings.push_back(d.time);
  }
  void open() {
    step.change_walls(state, {state.vessel.wall_index(scene.name == "sandpile" ? "gate" : "plug")}, {});
  }
  double copies() const { return state.weight(0); }

  Scene scene;
  State state;
  TimeStep step;
  double dt;
  Energies begin;
  RestCriterion rest;
  std::vector<double> crossings;  // s
  std::int64_t steps = 0;
};

double quantity(const StageResult& bed, const std::string& name) {
  for (const BedQuantity& q : bed.quantities)
    if (q.name == name) return q.value;
  return not_known;
}

/// The bed as it is at the end of a stage.
StageResult measured(const State& state, const Scene& scene) {
  return measure_stage_end(state, describe_domain(scene, state.symmetry, state.mean_diameter), {}, {});
}

/// What does not depend on how the bed is discharged.
void measure_settled(const Course& c, Result& result) {
  const State& state = c.state;
  const StageResult bed = measured(state, c.scene);
  const double weight = quantity(bed, "weight_of_grains");
  result["packing"] = quantity(bed, "packing");
  result["coordination"] = quantity(bed, "cn");
  result["floor"] = 0;
  for (const char* wall : {"floor", "plug", "plate", "gate"}) {
    const double load = quantity(bed, wall_load_name(wall));
    if (std::isfinite(load)) result["floor"] += load / weight;
  }
  const Particles& p = state.particles;
  const Vec3Array force = c.step.contact_forces(state);
  double overlap = 0, touching = 0, stress = 0, head = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k) {
    const double o = row_overlap(state, k);
    if (!(o > 0)) continue;
    overlap += o;
    touching += 1;
    stress += force.get(k).z * (p.position.z[static_cast<std::size_t>(state.contacts.first[k])] -
                                p.position.z[static_cast<std::size_t>(state.contacts.second[k])]);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) head += p.mass[i] * p.position.z[i];
  const double g = c.scene.domain.gravity.norm();
  result["overlap"] = overlap / touching / state.mean_diameter;
  result["stress"] = stress / (g * head);  // of the contacts, over that of a bed without walls
  result["heat"] = mean_kinetic_energy(state) / (p.mass[0] * g * state.mean_diameter);
  const EnergyBudget budget = energy_budget(state.energy, c.begin, c.step.energies(state));
  result["residual"] = budget.residual / budget.lost;
}

void discharge_hopper(Course& c, Size size, Result& result) {
  const double wanted = discharged_grains(size) / c.copies();
  const double jammed = 0.25;  // s without a grain: an arch stands
  const double opened = c.state.time;
  c.open();
  const auto last = [&] { return c.crossings.empty() ? opened : c.crossings.back(); };
  while (static_cast<double>(c.crossings.size()) < wanted && c.state.time < last() + jammed)
    c.some_steps(c.state.time + 1);
  std::vector<double> t = c.crossings;
  std::sort(t.begin(), t.end());
  const bool arched = static_cast<double>(t.size()) < wanted;
  result["arched"] = arched;
  result["rate"] = not_known;
  if (arched) return;
  const std::size_t low = t.size() / 10, high = t.size() - 1 - t.size() / 10;
  result["rate"] = c.copies() * static_cast<double>(high - low) / (t[high] - t[low]);
}

void collapse_pile(Course& c, Result& result) {
  c.open();
  result["pile_rests"] = c.settle(1.0);
  const StageResult bed = measured(c.state, c.scene);
  result["left"] = quantity(bed, "grains");
  result["angle"] = quantity(bed, "angle_of_repose");
}

constexpr double longest_settling = 1.0;  // s

void race_phase(std::vector<std::unique_ptr<Course>>& courses, const std::string& name, int rounds,
                std::vector<Result>& results) {
  const double window = 300 * courses[0]->dt;  // s: the same piece of time for all
  std::vector<std::vector<double>> ratios(courses.size());
  for (int round = 0; round < rounds; ++round) {
    std::vector<double> cost;
    for (const auto& c : courses) {
      const double before = computing_seconds();
      c->run(window);
      cost.push_back(computing_seconds() - before);
    }
    for (std::size_t k = 0; k < courses.size(); ++k) ratios[k].push_back(cost[0] / cost[k]);
  }
  for (std::size_t k = 0; k < courses.size(); ++k) {
    std::sort(ratios[k].begin(), ratios[k].end());
    results[k][name] = ratios[k][ratios[k].size() / 2];
    results[k][name + "_low"] = ratios[k].front();
    results[k][name + "_high"] = ratios[k].back();
  }
}

void compare(const Course& a, const Course& b, const std::string& name, Result& result) {
  std::map<std::int32_t, Vec3> places;
  const Particles &p = a.state.particles, &q = b.state.particles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) places[p.id[i]] = p.position.get(i);
  double squares = 0, largest = 0, count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(q.count()); ++i) {
    const auto found = places.find(q.id[i]);
    if (found == places.end()) continue;
    const double distance = norm(q.position.get(i) - found->second) / a.state.mean_diameter;
    squares += distance * distance;
    largest = std::max(largest, distance);
    count += 1;
  }
  result[name] = std::sqrt(squares / count);
  result[name + "_largest"] = largest;
}

}  // namespace

std::string Variant::name() const {
  std::string n;
  if (step != 10) n += "step" + number_text(step);
  if (young != 1e7) n += "young" + number_text(young);
  if (skin != 0) n += "skin" + number_text(skin);
  if (angle != 360) n += "sector" + number_text(angle) + axis;
  if (precision != "double") n += precision;
  return n.empty() ? "standard" : n;
}

std::string Firmness::name() const { return "young" + number_text(young) + "_damping" + number_text(damping); }

std::string scene_file(const std::string& scene) {
  return scene == "hopper" ? "apps/scenes/hopper_small.toml" : "apps/scenes/sandpile.toml";
}

std::vector<std::string> scaled_down(const std::string& scene, Size size) {
  const bool quick = size == Size::quick;
  if (scene == "hopper")
    return {R"(wall.shell.profile=[["6 d", 0], ["6 d", "40 d"]])", R"(wall.floor.profile=[["4 d", 0], ["6 d", 0]])",
            R"(particles.region={ r = [0, "6 d"], z = [0, "26 d"] })",
            quick ? "particles.count=480" : "particles.count=1440"};
  return {R"(wall.shell.profile=[["11 d", "-10 d"], ["11 d", 0], ["11 d", "20 d"]])",
          R"(wall.plate.profile=[[0, 0], ["7 d", 0]])", R"(wall.gate.profile=[["7 d", 0], ["11 d", 0]])",
          R"(particles.region={ r = [0, "11 d"], z = [0, "11 d"] })",
          quick ? "particles.count=960" : "particles.count=1920"};
}

Scene make_scene(const std::string& scene, const Variant& variant, int seed, Size size) {
  std::vector<std::string> overrides = scaled_down(scene, size);
  const std::string young = number_text(variant.young);
  for (const char* material : {"grain", "wall"})
    overrides.push_back(std::string("material.") + material + ".young=" + young);
  overrides.push_back("particles.seed=" + std::to_string(seed));
  overrides.push_back("domain.angle=" + std::to_string(variant.angle));
  overrides.push_back("domain.axis=" + variant.axis);
  overrides.push_back("run.precision=" + variant.precision);
  overrides.push_back("time.step=auto");  // set below
  if (variant.skin > 0) overrides.push_back("run.skin=\"" + number_text(variant.skin) + " d\"");
  Scene result = read_scene(std::string(WEDGE_SOURCE_DIR) + "/" + scene_file(scene), overrides);
  result.time_step = variant.step / 100 * rayleigh_time(result);
  return result;
}

Result bed_run(const std::string& scene, const Variant& variant, int seed, Size size) {
  Result result{{"broke", 0}};
  const double before = computing_seconds();
  Course c(make_scene(scene, variant, seed, size));
  try {
    result["bed_rests"] = c.settle(longest_settling);
    result["settling"] = c.state.time;
    measure_settled(c, result);
    if (scene == "hopper")
      discharge_hopper(c, size, result);
    else
      collapse_pile(c, result);
    const EnergyBudget budget = energy_budget(c.state.energy, c.begin, c.step.energies(c.state));
    result["residual_end"] = budget.residual / budget.lost;
  } catch (const PhysicsError&) {
    result["broke"] = 1;
  }
  result["seconds"] = computing_seconds() - before;
  result["steps"] = static_cast<double>(c.steps);
  return result;
}

std::vector<Result> race(const std::string& scene, const std::vector<Variant>& variants, Size size) {
  Course standard(make_scene(scene, {}, 1, size));
  standard.settle(longest_settling);
  std::vector<std::unique_ptr<Course>> courses;
  for (const Variant& v : variants) {
    Scene s = make_scene(scene, v, 1, size);
    if (v.angle == 360 && v.young == Variant().young) {
      courses.push_back(std::make_unique<Course>(std::move(s), standard));
    } else {
      courses.push_back(std::make_unique<Course>(std::move(s)));
      courses.back()->settle(longest_settling);
    }
  }
  std::vector<Result> results(variants.size());
  const int rounds = size == Size::full ? 7 : 3;
  race_phase(courses, "speed_rest", rounds, results);
  for (const auto& c : courses) {
    c->open();
    c->run(2500 * courses[0]->dt);
  }
  race_phase(courses, "speed_flow", rounds, results);
  return results;
}

Result stability(const std::string& scene, Firmness firmness, Size size) {
  Variant v;
  v.young = firmness.young;
  if (firmness.damping > 0.3) v.step = 5;  // 10 % may be too long for such a bed
  const auto make = [&] {
    Scene s = make_scene(scene, v, 1, size);
    for (int a = 0; a < 2; ++a) {  // grains with grains, with walls
      Interaction& pair = s.interactions(a, 0);
      pair.damping_normal = pair.damping_tangential = firmness.damping;
    }
    return s;
  };
  Course settled(make());
  settled.settle(longest_settling);
  Result result;
  measure_settled(settled, result);
  const double duration = 1000 * rayleigh_time(settled.scene);
  for (const double step : long_steps) {
    v.step = step;
    Course c(make(), settled);
    double& heat = result["heat" + number_text(step)];
    try {
      c.run(duration);
      Result now;
      measure_settled(c, now);
      heat = now["heat"];
    } catch (const PhysicsError&) {
      heat = std::numeric_limits<double>::infinity();
    }
  }
  return result;
}

Result drift(const std::string& scene, const std::string& other, int seed, Size size) {
  Course start(make_scene(scene, {}, seed, size));
  start.settle(longest_settling);
  start.open();
  start.run(2000 * start.dt);
  Variant v;
  if (other != "nudged") v.precision = other;
  Course a(start.scene, start), b(make_scene(scene, v, seed, size), start);
  if (other == "nudged") {
    Vec3Array& x = b.state.particles.position;
    for (Array<double>* part : {&x.x, &x.y, &x.z})
      for (double& value : *part) value = std::nextafter(value, 1e9);
  }
  Result result;
  for (const int steps : {10, 100, 1000}) {
    for (Course* c : {&a, &b}) c->run((steps - static_cast<double>(c->steps)) * c->dt);
    compare(a, b, "after" + std::to_string(steps), result);
  }
  return result;
}

}  // namespace wedge::speed_error
