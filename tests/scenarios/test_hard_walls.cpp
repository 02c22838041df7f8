// test_hard_walls.cpp: hard cases of walls: grains exactly on the axis, a face, an edge, two edges; narrow places;
// moving walls; grains that leave while they touch. The scenes are in hard_cases/.
#include <fstream>
#include <set>

#include "tests/support/experiment.hpp"
#include "tests/support/known_answer.hpp"
#include "tests/support/scene_run.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

void report(const std::string& place, const std::string& scene, const std::string& must, const std::string& found) {
  write_row("hard cases", place, {scene, must, found});
}

double vertical_load(const Experiment& e) {
  double sum = 0;
  for (const WallLoad& wall : wall_loads(e.state)) sum -= wall.force.z;
  return sum;
}

}  // namespace

TEST_CASE("hard: a grain exactly on the axis, on a face, on both", "[hard]") {
  for (const int n : {2, 3, 4, 12}) {
    for (const AxisRule axis : {AxisRule::clamp, AxisRule::pin}) {
      Scene s = hopper_material();
      make_sector(s, n, axis);
      add_wall(s, "floor", {{0, 0}, {0.03, 0}});
      s.domain.gravity = {0, 0, -9.81};
      const double far = 3 * d;  // beyond the copies of the one on the other face
      const std::vector<Grain> grains{{R, {0, 0, R + 1e-4}, {}, {}}, {R, {far, 0, R + 1e-4}, {}, {}}};
      Experiment e(s, grains, 1e-5);
      e.run(20000);
      CHECK(vertical_load(e) == Approx(2 * e.mass(0) * 9.81).epsilon(1e-6));
      CHECK(std::hypot(e.x(0).x, e.x(0).y) == 0);
      CHECK(norm(e.x(1) - Vec3{far, 0, e.x(1).z}) < 1e-15);
      CHECK(e.touching_walls() == 2);
    }
  }
  report("20", "grains exactly on the axis and on a face, n 2, 3, 4, 12, clamp and pin", "stay; load = weight",
         "they do");
}

TEST_CASE("hard: a grain exactly on the axis where it has no place: images, line, hollow", "[hard]") {
  for (const int n : {2, 3, 4, 12}) {
    for (const AxisRule axis : {AxisRule::images, AxisRule::line, AxisRule::hollow}) {
      CAPTURE(n, static_cast<int>(axis));
      Scene s = hopper_material();
      make_sector(s, n, axis);
      if (axis == AxisRule::hollow) s.domain.inner_radius = 0.01;
      add_wall(s, "floor", {{0, 0}, {0.03, 0}});
      s.domain.gravity = {0, 0, -9.81};
      const Vec3 on_face{0.015, 0, R + 1e-4}, on_axis{0, 0, R + 1e-4};
      Experiment e(s, {{R, on_face, {}, {}}}, 1e-5);  // on a face, and with the inner cylinder one diameter away
      e.run(20000);
      CHECK(vertical_load(e) == Approx(e.mass(0) * 9.81).epsilon(1e-6));
      CHECK(norm(e.x(0) - Vec3{0.015, 0, e.x(0).z}) < 1e-15);

      const ScratchFolder scratch;  // on the axis: refused by the setup of a run, or by the first list
      std::ofstream(scratch / "start.csv") << "id,x,y,z,vx,vy,vz,wx,wy,wz\n0,0,0," << on_axis.z << ",0,0,0,0,0,0\n";
      s.particles.grains = StateFile{scratch / "start.csv", d, 0};
      s.stages.resize(1);
      s.time_step = 1e-5;
      using Catch::Matchers::Contains;
      if (axis == AxisRule::images) {
        CHECK_THROWS_WITH(make_start(s), Contains("lies on the axis"));
        CHECK_THROWS_WITH(Experiment(s, {{R, on_axis, {}, {}}}, 1e-5), Contains("grains 0 and 0"));
      } else if (axis == AxisRule::line) {
        CHECK_THROWS_WITH(SceneRun(s),
                          Contains("grain 0") && Contains("overlaps the wall 'axis line' by 0.0025 m"));
      } else {
        CHECK_THROWS_WITH(make_start(s), Contains("grain 0 starts outside the vessel"));
      }
    }
  }
  report("20x", "a grain exactly on the axis, n 2, 3, 4, 12, images, line, hollow; one on a face",
         "refused by name; the one on the face stays", "they are");
}

TEST_CASE("hard: a grain on an edge, and in a gap on two edges at once", "[hard]") {
  Scene one = hopper_material();
  add_wall(one, "ring", {{0.02, 0}, {0.03, 0}});
  one.domain.gravity = {0, 0, -9.81};
  Experiment on_edge(one, {{R, {0.02, 0, R - 1e-6}, {}, {}}}, 1e-5);
  on_edge.run(200);
  CHECK(on_edge.touching_walls() == 1);  // at the end of the ring the segment and the edge are one contact

  Scene two = one;
  const double gap = 0.9 * d;
  add_wall(two, "disc", {{0, 0}, {0.02 - gap, 0}});
  Experiment between(two, {{R, {0.02 - 0.5 * gap, 0, std::sqrt(R * R - 0.25 * gap * gap)}, {}, {}}}, 1e-5);
  between.run(60000);
  CHECK(between.touching_walls() == 2);
  CHECK(vertical_load(between) == Approx(between.mass(0) * 9.81).epsilon(1e-4));
  CHECK(norm(between.v(0)) < 1e-6);
  report("21", "a grain in a ring gap of 0.9 d", "held by both edges; load = weight",
         "load " + text("%.5f", vertical_load(between) / (between.mass(0) * 9.81)));
}

TEST_CASE("hard: a corner of 30 degrees and a tube one grain wide", "[hard]") {
  SceneRun t(hard_case("narrow"));
  t.run(0.8);
  t.check_sound();
  CHECK(t.load() == Approx(t.weight()).epsilon(0.02));
  int in_tube = 0;
  for (Index i = 0; i < t.state.particles.count(); ++i)
    in_tube += t.state.particles.position.z[static_cast<std::size_t>(i)] < 0.05;
  CHECK(in_tube >= 1);
  report("22", "narrow: a funnel of 30 degrees into a tube of 1.12 d", "nothing is lost; load = weight",
         text("%.0f", in_tube) + " grains in the tube, load " + text("%.4f", t.load() / t.weight()) +
             " of the weight");

  Scene wedge_shaped = hopper_material();
  add_wall(wedge_shaped, "groove",
           {{0.02, 0.05}, {0.02 + 0.05 * std::tan(pi / 12), 0}, {0.02 + 0.1 * std::tan(pi / 12), 0.05}});
  wedge_shaped.domain.gravity = {0, 0, -9.81};
  Experiment e(wedge_shaped, {{R, {0.02 + 0.05 * std::tan(pi / 12), 0, 0.015}, {}, {}}}, 1e-5);
  e.run(60000);
  CHECK(e.touching_walls() == 2);
  CHECK(vertical_load(e) == Approx(e.mass(0) * 9.81).epsilon(1e-3));
  CHECK(e.x(0).z > 0);
  report("23", "a grain in a groove of 30 degrees", "held by both flanks; load = weight",
         "load " + text("%.5f", vertical_load(e) / (e.mass(0) * 9.81)));
}

TEST_CASE("hard: a spinning shell carries a grain along", "[hard]") {
  Scene s = hopper_material();
  add_wall(s, "shell", {{0.05, -1}, {0.05, 1}});
  s.walls[0].spin = 8;
  s.contact.rolling_velocity =
      RollingVelocity::relative;  // against its own spin a grain could not turn with the shell
  s.interactions(0, 0).rolling = 0.2 * R;
  s.domain.gravity = Eigen::Vector3d::Zero();
  Experiment e(s, {{R, {0.05 - R, 0, 0}, {0, 0.1, 0}, {}}}, 1e-5);
  e.run(300000);
  const double r = std::hypot(e.x(0).x, e.x(0).y);
  CHECK(norm(e.v(0)) == Approx(8 * r).epsilon(1e-3));
  CHECK(e.w(0).z == Approx(8).epsilon(1e-3));
  const EnergyLedger& l = e.state.energy;
  CHECK(std::fabs(e.residual()) < 1e-2 * l.wall_work);
  report(
      "24", "a grain in a shell that spins at 8 rad/s, no gravity", "turns with the shell",
      "speed " + text("%.5f", norm(e.v(0)) / (8 * r)) + ", spin " + text("%.5f", e.w(0).z / 8) + " of the shell's");
}

TEST_CASE("hard: a rising floor lifts a bed", "[hard]") {
  // Friction on the shell loosens and packs the bed as it rises, a little differently for each seed (height up to
  // 0.07 d less): only the budget is sharp. Without friction a bed at rest rises as one.
  for (const bool friction : {true, false}) {
    std::vector<std::string> overrides{"wall.floor.speed=0.05"};
    if (!friction)
      overrides.insert(overrides.end(), {"contact.grain-grain.sliding=0", "contact.grain-grain.rolling=0"});
    SceneRun lift(hard_case("pot", overrides));
    lift.run(friction ? 0.4 : 1.6);
    const double height = lift.mean_height(), potential = lift.step.energies(lift.state).potential;
    const double work = lift.state.energy.wall_work, lost = lift.dissipated(), residual = lift.residual();
    lift.run(0.4);
    lift.check_sound();
    const double risen = (lift.mean_height() - height) / (0.05 * 0.4);
    const double gained = lift.step.energies(lift.state).potential - potential;
    const double given = lift.state.energy.wall_work - work, used = gained + lift.dissipated() - lost;
    if (friction) {
      CHECK(risen == Approx(1).margin(0.1));
      CHECK(std::fabs(lift.residual() - residual) < 1e-3 * given);
      CHECK(lift.dissipated() > lost);
    } else {
      CHECK(risen == Approx(1).margin(1e-3));
      CHECK(given == Approx(used).epsilon(1e-3));
    }
    report(friction ? "25" : "25b",
           std::string("pot, floor rising at 0.05 m/s") + (friction ? "" : ", no friction"),
           friction ? "lifts the bed; budget closed" : "lifts the bed as a whole; work = potential energy + losses",
           text("%.4f", risen) + " of the way, work " + text("%.5f", given / used) +
               " of potential energy + losses, residual " +
               text("%.0e", std::fabs(lift.residual() - residual) / given) + " of the work");
  }
}

namespace {

/// Ids of the grains that touch another one.
std::set<std::int32_t> touching_grains(const State& state) {
  std::set<std::int32_t> ids;
  const ContactTable& c = state.contacts;
  for (std::size_t k = 0; k < static_cast<std::size_t>(c.rows()); ++k) {
    if (!(row_overlap(state, k) > 0)) continue;
    ids.insert(state.particles.id[static_cast<std::size_t>(c.first[k])]);
    ids.insert(state.particles.id[static_cast<std::size_t>(row_partner(state, k).grain)]);
  }
  return ids;
}

}  // namespace

TEST_CASE("hard: a bed that falls out of its pot at once, or sinks out of it, grains leaving while they touch",
          "[hard]") {
  for (const bool sinks : {false, true}) {
    for (const char* angle : {"domain.angle=360", "domain.angle=60"}) {
      CAPTURE(sinks, angle);
      std::vector<std::string> overrides{angle};
      if (sinks)
        overrides.insert(overrides.end(), {"contact.grain-grain.sliding=0", "contact.grain-grain.rolling=0"});
      Scene scene = hard_case("outlet", overrides);
      if (sinks) {  // on a floor that carries the bed, which no shell holds back, down to the outlet
        scene.walls[0].profile[0].y() = -0.2;
        scene.walls[1].speed = -0.1;
        scene.domain.outlet_height = -0.06;
      }
      SceneRun t(scene);
      t.run(0.5);
      if (!sinks) CHECK(t.load() == Approx(t.weight()).epsilon(0.01));
      if (!sinks) t.open("floor");
      int touching = 0;  // of the grains that left
      while (t.state.particles.count() > 0 && t.state.time < 1.6) {
        const std::set<std::int32_t> before = touching_grains(t.state);
        t.run_steps(1);
        for (const Departure& gone : t.step.take_departures()) touching += before.count(gone.id) > 0;
      }
      CHECK(t.state.particles.count() == 0);
      CHECK(t.state.taken_out == t.state.put_in);
      if (sinks) CHECK(15 * touching > t.state.put_in);
      CHECK(touching >= 1);
      CHECK(std::fabs(t.residual()) < 0.02 * t.dissipated());
      report(std::string("26") + (sinks ? "b" : "") + angle,
             std::string("outlet, ") + angle + (sinks ? ", on a sinking floor" : ""),
             "all leave, some while touching, ledger exact, budget closed",
             text("%.0f", touching) + " of " + text("%.0f", static_cast<double>(t.state.put_in)) +
                 " leave while touching another grain, residual " +
                 text("%.2f", 100 * std::fabs(t.residual()) / t.dissipated()) + " % of the losses");
    }
  }
}

TEST_CASE("hard: two grains pressed together leave one after the other", "[hard]") {
  Scene s = plain_scene(1e7, 0.3, 3800);
  s.domain.outlet_height = 0;
  const double overlap = 0.1 * d;
  Experiment e(s, {{R, {0, 0, 1e-4}, {0, 0, -10}, {}}, {R, {0, 0, 1e-4 + d - overlap}, {0, 0, -10}, {}}}, 1e-7);
  const double stored = e.begin.elastic_normal;
  double left = 0;  // stored in the contact when the first one leaves
  CHECK(e.run_until(
      [&] {
        if (e.state.taken_out == 0) left = e.step.energies(e.state).elastic_normal;
        return e.state.taken_out == 2;
      },
      100000));
  CHECK(left > 0.5 * stored);
  CHECK(std::fabs(e.residual()) < 0.01 * left);
  report("26c", "two grains pressed together fly through the outlet",
         "the first takes the contact's energy with it",
         "residual " + text("%.1e", std::fabs(e.residual()) / left) + " of it");
}

TEST_CASE("hard: a gap of exactly one diameter", "[hard]") {
  int fell = 0, held = 0;
  const auto drop = [&](const Scene& scene, Vec3 x) {
    Experiment e(scene, {{R, x, {}, {}}}, 1e-5);
    const bool out = e.run_until([&] { return e.state.particles.count() == 0; }, 100000);
    CHECK(e.state.put_in == e.state.particles.count() + e.state.taken_out);
    ++(out ? fell : held);
    if (out) return;
    CHECK(vertical_load(e) == Approx(e.mass(0) * 9.81).epsilon(1e-3));
    CHECK(std::fabs(e.x(0).z) < R);
    CHECK(norm(e.v(0)) < 1e-6);
  };
  const Vec3 direction{std::cos(0.3), std::sin(0.3), 0}, above{0, 0, 0.01};
  for (const int n : {1, 6}) {
    Scene ring = hopper_material();
    if (n > 1) make_sector(ring, n, AxisRule::clamp);
    ring.domain.gravity = {0, 0, -9.81};
    ring.domain.outlet_height = -0.01;
    add_wall(ring, "outer", {{0.02, 0}, {0.03, 0}});
    Scene orifice = ring;
    add_wall(ring, "inner", {{0, 0}, {0.02 - d, 0}});
    orifice.walls[0].profile = {{R, 0}, {0.03, 0}};
    for (const double aside : {0.0, 1e-15, 1e-9, 1e-6, 1e-4}) {
      CAPTURE(n, aside);
      drop(ring, (0.02 - R + aside) * direction + above);
      drop(orifice, aside * direction + above);
    }
  }
  // With the axis rule clamp a grain beside the axis cannot move in to pass an orifice in the middle.
  CHECK(fell >= 16);
  report("27",
         "one grain over a ring gap and over an orifice of exactly 1 d, on its centre and up to 0.02 d off it",
         "leaves, or is held with load = weight", text("%.0f", fell) + " leave, " + text("%.0f", held) + " held");

  for (const char* angle : {"domain.angle=360", "domain.angle=60"}) {
    Scene scene = hard_case("outlet", {angle});
    scene.walls[1].profile = {{R, 0}, {0.02, 0}};  // the floor
    SceneRun t(scene);
    t.run(0.6);
    t.check_sound();
    CHECK(t.load() == Approx(t.weight()).epsilon(0.01));
    CHECK(t.unexplained() < 0.02);
    report(std::string("28") + angle, std::string("outlet with an orifice of exactly 1 d, ") + angle,
           "ledger exact, load = weight of those inside",
           text("%.0f", static_cast<double>(t.state.taken_out)) + " leave, load " +
               text("%.5f", t.load() / t.weight()) + " of the weight");
  }
}
