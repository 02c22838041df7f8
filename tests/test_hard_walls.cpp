// test_hard_walls.cpp: hard cases of walls: grains exactly on the axis, a face, an edge, two edges; narrow places;
// moving walls; grains that leave while they touch. The scenes are in hard_cases/.
#include <fstream>
#include <set>

#include "tests/laboratory.hpp"
#include "tests/ladder.hpp"
#include "tests/scratch_folder.hpp"
#include "tests/trial.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

void report(const std::string& place, const std::string& scene, const std::string& must, const std::string& found) {
  write_row("hard", place, {scene, must, found});
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
  report("20", "grains exactly on the axis and on a face, n 2, 3, 4, 12", "stay; load = weight", "so they do");
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
  Trial t(hard_case("narrow"));
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

TEST_CASE("hard: a spinning shell carries a grain along, a rising floor lifts a bed", "[hard]") {
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

  Trial lift(hard_case("pot", {"wall.floor.speed=0.05"}));
  lift.run(0.4);
  const double height = lift.mean_height(), potential = lift.step.energies(lift.state).potential;
  const double work = lift.state.energy.wall_work, lost = lift.dissipated();
  lift.run(0.4);
  lift.check_sound();
  CHECK(lift.mean_height() - height == Approx(0.05 * 0.4).margin(0.1 * d));
  const double gained = lift.step.energies(lift.state).potential - potential;
  CHECK(lift.state.energy.wall_work - work == Approx(gained + lift.dissipated() - lost).epsilon(0.02));
  CHECK(lift.unexplained() < 0.03);
  report("25", "pot, floor rising at 0.05 m/s", "lifts the bed; work = potential energy + losses",
         "work " + text("%.4f", (lift.state.energy.wall_work - work) / (gained + lift.dissipated() - lost)) +
             " of it, residual " + text("%.2f", 100 * lift.unexplained()) + " %");
}

TEST_CASE("hard: a bed that falls out of its pot at once, grains leaving while they touch", "[hard]") {
  for (const char* angle : {"domain.angle=360", "domain.angle=60"}) {
    Trial t(hard_case("outlet", {angle}));
    t.run(0.3);
    CHECK(t.load() == Approx(t.weight()).epsilon(0.01));
    t.open("floor");
    int touching = 0;
    while (t.state.particles.count() > 0 && t.state.time < 1.3) {
      const auto before = t.state.taken_out;
      t.run_steps(1);
      if (t.state.taken_out > before) touching += t.deepest_overlap() > 0;
      t.state.departures.clear();
    }
    CHECK(t.state.particles.count() == 0);
    CHECK(t.state.taken_out == t.state.put_in);
    CHECK(touching > 3);
    CHECK(std::fabs(t.residual()) < 0.02 * (t.dissipated() + t.state.energy.carried_out));
    report(std::string("26") + angle, std::string("outlet, ") + angle, "all leave, ledger exact, budget closed",
           "residual " + text("%.2f", 100 * std::fabs(t.residual()) / t.dissipated()) + " % of the losses");
  }
}
