// test_hard_beds.cpp: hard cases of beds: long steps, soft and stiff grains, sizes and densities far apart, no
// damping, long rest, few grains and many. The scenes are in hard_cases/.
#include "apps/results/run_folder.hpp"
#include "apps/run/simulation.hpp"
#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/checks.hpp"
#include "tests/support/known_answer.hpp"
#include "tests/support/scene_run.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

void report(const std::string& place, const std::string& scene, const std::string& must, const std::string& found) {
  write_row("hard cases", place, {scene, must, found});
}

/// Load on the walls over the last steps against weight + dP_z/dt, as a part of the weight.
double load_error(SceneRun& t) {
  const double before = momentum(t.state).z;
  double impulse = 0.5 * t.load();
  const int steps = 200;
  for (int k = 0; k < steps; ++k) {
    t.run_steps(1);
    impulse += (k + 1 < steps ? 1.0 : 0.5) * t.load();
  }
  const double mean = impulse / steps, rate = (momentum(t.state).z - before) / (steps * t.dt);
  return std::fabs(mean - t.weight() - rate) / t.weight();
}

/// Falls and settles: sound, load = weight + dP_z/dt, budget closed, at rest. Returns what is said of it in the
/// table.
std::string settles(const std::string& name, const std::vector<std::string>& overrides, double seconds) {
  SceneRun t(hard_case(name, overrides));
  t.run(seconds);
  t.check_sound();
  CHECK(load_error(t) < 1e-9);
  CHECK(t.unexplained() < 0.01);
  const double left = t.step.energies(t.state).kinetic / t.dissipated();
  CHECK(left < 0.02);
  return "residual " + text("%.2f", 100 * t.unexplained()) + " % and kinetic energy " + text("%.0e", 100 * left) +
         " % of the losses, deepest overlap " + text("%.2g", 100 * t.deepest_overlap() / t.state.mean_diameter) +
         " % of the mean d";
}

/// What a run of the whole program's driver left: the physics error that ended it or "", its log, its last state.
struct RealRun {
  std::string error, log;
  std::int64_t steps = 0;
  double energy = 0;  // as a part of that at the start
};
RealRun real_run(const Scene& scene) {
  const ScratchFolder scratch;
  const RunFolder folder(scratch.path());
  Simulation run = Simulation::begin(scene, folder);
  State at_start = run.state();
  const TimeStep step(scene, at_start);
  const double start = step.energies(at_start).total();
  RealRun result;
  try {
    run.run({});
  } catch (const PhysicsError& error) {
    result.error = error.what();
  }
  result.log = read_text_file(folder.log());
  result.steps = run.state().step;
  result.energy = step.energies(run.state()).total() / start;
  return result;
}

/// Grains that fly about in a closed can and lose nothing.
Scene closed_can(int seed) {
  Scene scene = hard_case(
      "pot", {"domain.gravity=[0,0,0]", "particles.count=24", "particles.speed=0.5",
              "contact.grain-grain.sliding=0", "contact.grain-grain.rolling=0", "contact.grain-grain.damping=0",
              "particles.region.z=[0, 0.04]", "particles.seed=" + std::to_string(seed)});
  scene.walls[0].profile = {{0.02, 0}, {0.02, 0.04}, {0, 0.04}};
  return scene;
}

}  // namespace

TEST_CASE("hard: steps of 5 to 20 per cent of the Rayleigh time", "[hard]") {
  for (const double part : {0.05, 0.10, 0.20}) {
    CAPTURE(part);
    Scene scene = hard_case("pot");
    scene.time_step = part * rayleigh_time(scene);
    SceneRun t(scene);
    t.run(0.4);
    CHECK(t.finite());
    CHECK(t.unexplained() < 0.02 * std::pow(part / 0.1, 2));
    CHECK(t.load() == Approx(t.weight()).epsilon(0.01));
    const RealRun run = real_run(scene);
    CHECK(run.error == "");
    CHECK(run.log.find("warning") == std::string::npos);
    report("01" + text("%.2f", part), "pot, step " + text("%.0f", 100 * part) + " % of Rayleigh",
           "comes to rest, budget closed, no warning",
           "runs; residual " + text("%.2g", 100 * t.unexplained()) + " % of the losses, " +
               text("%.1e", t.step.energies(t.state).kinetic / t.state.particles.count()) + " J a grain left");
  }
}

TEST_CASE("hard: steps of 25 to 80 per cent of the Rayleigh time end with a physics error", "[hard]") {
  for (const double part : {0.25, 0.30, 0.40, 0.80}) {
    CAPTURE(part);
    Scene scene = hard_case("pot");
    scene.time_step = 0.9999 * part * rayleigh_time(scene);
    const RealRun run = real_run(scene);  // the reader refuses the longest: it is set after reading
    CAPTURE(run.error);
    CHECK(run.error.find("Likely cause") != std::string::npos);  // a guard threw
    CHECK(run.error.find("time step") != std::string::npos);
    const std::vector<std::string> step{"time.step=" + std::to_string(1e6 * scene.time_step) + "e-6"};
    const bool accepted = scene.time_step <= step_scale(scene).refused;
    if (accepted) {
      CHECK(scene_warnings(hard_case("pot", step)).size() >= 1);
      CHECK(run.error.find("the energy budget is broken") != std::string::npos);
      CHECK(run.energy < 1);
    } else {
      CHECK_THROWS_AS(hard_case("pot", step), SceneError);
    }
    report("01" + text("%.2f", part), "pot, step " + text("%.0f", 100 * part) + " % of Rayleigh",
           "ends with a physics error",
           std::string(accepted ? "`check` warns" : "refused by `check`; forced past it") + ": stopped after " +
               text("%.0f", static_cast<double>(run.steps)) + " steps with " + text("%.2f", run.energy) +
               " of the energy at the start, " + run.error.substr(0, run.error.find(" in step")));
  }
}

/// Overlaps are looked at when the list is made: `overlap_limit` of the smaller radius, 0.3 d. Until the next list
/// the pair may come closer by its two margins.
TEST_CASE("hard: head-on impacts up to overlaps of a fifth of a diameter, and beyond", "[hard]") {
  const double d = 0.005, limit = 0.5 * overlap_limit * d;
  for (const double speed : {1.0, 5.0, 10.0}) {
    for (const double damping : {0.0, 0.3}) {
      CAPTURE(speed, damping);
      Scene scene = hard_case("pot", {"domain.gravity=[0,0,0]"});
      scene.walls.clear();
      scene.interactions(0, 0).damping_normal = damping;
      SceneRun t(scene);
      Particles& p = t.state.particles;
      p.resize(2);
      p.position.set(0, {0, 0, 0});
      p.position.set(1, {0.00501, 0, 0});
      p.velocity.set(0, {speed, 0, 0});
      p.velocity.set(1, {-speed, 0, 0});
      for (std::size_t i = 0; i < 2; ++i) p.angular_velocity.set(i, {}), p.id[i] = static_cast<int>(i);
      t.state.put_in = 2;
      t.state.contacts = {};
      t.dt /= 10;
      t.step.start(t.state, t.dt);
      double deepest = 0, margins = 0;
      std::string found;
      try {
        for (int k = 0; k < 4000; ++k) {
          margins = std::max(margins, p.list_margin[0] + p.list_margin[1]);
          t.run_steps(1);
          deepest = std::max(deepest, t.deepest_overlap());
        }
        const double rebound = -p.velocity.x[0] * (p.id[0] == 0 ? 1 : -1) / speed;
        CHECK(rebound == Approx(damping > 0 ? 0.3352 : 1.0).margin(5e-3));
        found = "rebounds with " + text("%.3f", rebound) + " of its speed";
      } catch (const PhysicsError& error) {
        CHECK(std::string(error.what()).find("overlap by") != std::string::npos);
        CHECK(deepest > limit);
        found = "stopped by the guard";
      }
      CHECK(deepest < limit + margins);
      CHECK(margins < 0.15 * d);
      report("02" + text("%04.0f", speed) + text("%.1f", damping),
             "two grains at " + text("%g", speed) + " m/s each, c_n " + text("%g", damping),
             "rebounds, or is stopped by the guard: above 0.3 d when a list is made, at the latest the margins "
             "(0.15 d) later",
             found + ", overlap " + text("%.1f", 100 * deepest / d) + " % d");
    }
  }
}

TEST_CASE("hard: sizes 1 to 10, densities 1 to 1000, soft and stiff grains, friction 0 and 2", "[hard]") {
  const char* must = "nearly comes to rest, load = weight + dP/dt, budget closed";
  report("03", "sizes: diameters 1 and 10 mm", must, settles("sizes", {}, 0.3));
  report("04", "densities: 100 and 100 000 kg/m3", must, settles("densities", {}, 0.3));
  report("05", "pot, E = 1e6 Pa", must, settles("pot", {"material.grain.young=1e6", "time.step=auto"}, 0.4));
  report(
      "06", "pot, E = 7e10 Pa, 60 grains, from a small height", must,
      settles("pot",
              {"material.grain.young=7e10", "time.step=auto", "particles.count=60", "particles.region.z=[0, 0.03]"},
              0.25));
  report("07", "pot, sliding 0, rolling 0", must,
         settles("pot", {"contact.grain-grain.sliding=0", "contact.grain-grain.rolling=0"}, 1.5));
  report("08", "pot, sliding 2", must, settles("pot", {"contact.grain-grain.sliding=2"}, 0.4));
}

TEST_CASE("hard: a million steps without damping and friction keep the energy", "[hard]") {
  // Each impact adds an error of second order, up or down as its first touch falls into a step: the energy wanders,
  // and one run says little. Root mean square over runs and times.
  const int runs = 6, looks = 6;
  const auto wandering = [&](double factor) {  // with the scene's step times this, for the same time
    double squares = 0;
    for (int seed = 1; seed <= runs; ++seed) {
      Scene scene = closed_can(seed);
      scene.time_step *= factor;
      SceneRun t(scene);
      double run = 0;
      for (int k = 0; k < looks; ++k) {
        t.run_steps(std::llround(10000 / factor));
        run += std::pow(t.step.energies(t.state).total() / t.begin.total() - 1, 2);
      }
      squares += run;
      t.check_sound();
      CHECK(t.dissipated() == 0);
    }
    return std::sqrt(squares / (runs * looks));
  };
  const double coarse = wandering(1), fine = wandering(0.5);
  CAPTURE(coarse, fine);
  CHECK(coarse < 1e-3);
  CHECK(fine < 0.4 * coarse);
  report("09",
         "24 grains in a closed can, no damping, no friction, 6 seeds, 10^6 steps in all, part of them at half the "
         "step",
         "energy kept, to the second order in the step",
         "wanders by " + text("%.1e", coarse) + " and " + text("%.1e", fine) + " of it");

  // 17 times as long as each of those: errors of either sign add up to some 1e-3, errors of one sign to far more.
  SceneRun t(closed_can(1));
  t.run_steps(1000000);
  t.check_sound();
  CHECK(t.dissipated() == 0);
  const double drift = t.step.energies(t.state).total() / t.begin.total() - 1;
  CHECK(std::fabs(drift) < 3e-3);
  report("09b", "24 grains in a closed can, no damping, no friction, one run of 10^6 steps", "energy kept",
         "drift " + text("%.1e", drift));
}

TEST_CASE("hard: friction without damping: the budget closes by the history coupling", "[hard]") {
  SceneRun t(hard_case("pot", {"contact.grain-grain.damping=0", "contact.grain-grain.rolling=0"}));
  t.run(1.0);
  t.check_sound();
  const double coupling = history_coupling(t.state.energy, t.begin, t.step.energies(t.state)) / t.dissipated();
  CHECK(t.unexplained() < 0.02);
  report("10", "pot, friction but no damping", "budget closed, history coupling reported",
         "history coupling " + text("%.1f", 100 * coupling) + " %, residual " +
             text("%.2f", 100 * t.unexplained()) + " % of the losses");
}

TEST_CASE("hard: a bed at rest stays at rest for ten seconds", "[hard]") {
  SceneRun t(hard_case("pot"));
  t.run(2.0);
  const double height = t.mean_height(), lost = t.dissipated();
  t.run(8.0);
  t.check_sound();
  const double creep = std::fabs(t.mean_height() - height) / 0.005, spin = t.largest_spin();
  CHECK(creep < 1e-9);
  CHECK(spin < 1e-9);
  CHECK(t.dissipated() - lost < 1e-12 * lost);
  CHECK(t.load() == Approx(t.weight()).epsilon(1e-9));
  report("11", "pot, at rest from 2 s to 10 s", "no creep, no spin",
         "centre of mass moves " + text("%.1e", creep) + " d, largest spin " + text("%.1e", spin) + " 1/s");
}

TEST_CASE("hard: an empty sector, one grain, two sectors", "[hard]") {
  Scene empty = hard_case("pot", {"domain.angle=30", "particles.count=12"});
  std::get<RandomFill>(empty.particles.grains).count = 0;
  SceneRun none(empty);
  none.run_steps(1000);
  CHECK(none.state.particles.count() == 0);
  SceneRun one(hard_case("pot", {"domain.angle=30", "particles.count=12"}));
  CHECK(one.state.particles.count() == 1);
  one.run(0.3);
  one.check_sound();
  CHECK(one.load() == Approx(one.weight()).epsilon(1e-6));
  const char* must = "nearly comes to rest, load = weight + dP/dt, budget closed";
  report("12", "pot, no grain in 30 degrees", "runs", "1000 steps");
  report("13", "pot, one grain in 30 degrees", must, "load " + text("%.6f", one.load() / one.weight()));
  report("14", "pot, 180 degrees", must, settles("pot", {"domain.angle=180"}, 0.4));
  report("15", "pot, 180 degrees, axis images", must,
         settles("pot", {"domain.angle=180", "domain.axis=images"}, 0.4));
}

TEST_CASE("hard: a sector of 3 degrees around an inner cylinder, and thinner than a grain is refused", "[hard]") {
  const std::string found = settles("hollow", {}, 0.4);
  report("16", "hollow: 3 degrees, D = 100 d, 500 grains",
         "nearly comes to rest, load = weight + dP/dt, budget closed", found);
  std::string complaint;
  try {
    hard_case("hollow",
              {"wall.trough.profile=[[\"5 d\",0],[\"20 d\",0],[\"20 d\",0.3]]", "domain.inner_radius=\"5 d\"",
               "particles.region.r=[\"5 d\",\"20 d\"]", "particles.count=6000"});
  } catch (const SceneError& error) {
    complaint = error.what();
  }
  CHECK(complaint.find("the sector is too thin") != std::string::npos);
}

TEST_CASE("the energy budget of every shipped scene closes with the step", "[hard]") {
  struct Row {
    const char *name, *angle;
  };
  for (const Row& row :
       {Row{"hopper", "60"}, Row{"hopper_small", "60"}, Row{"sandpile", "60"}, Row{"demo", "90"}}) {
    CAPTURE(row.name);
    Scene scene = read_scene(std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/" + row.name + ".toml",
                             {std::string("domain.angle=") + row.angle, "particles.count=3600"});
    const auto unexplained = [&](double factor) {
      scene.time_step *= factor;
      SceneRun t(scene);
      t.run(0.3);
      t.check_sound();
      return t.unexplained();
    };
    const double coarse = unexplained(1), fine = unexplained(0.5);
    CHECK(coarse < 0.02);
    CHECK(fine < 0.4 * coarse);
    report(std::string("40") + row.name,
           std::string(row.name) + ".toml at " + row.angle +
               " degrees, 3600 grains in the full vessel, 0.3 s, its step and half of it",
           "residual falls with the step",
           "residual " + text("%.2f", 100 * coarse) + " and " + text("%.2f", 100 * fine) + " % of the losses");
  }
}
