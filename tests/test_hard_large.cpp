// test_hard_large.cpp: hard cases that take long: a million steps, a heavy drop, two million grains.
#include "tests/ladder.hpp"
#include "tests/trial.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("hard: one run of a million steps without damping and friction", "[hard][large]") {
  // Its energy wanders by impacts whose errors have either sign (test_hard_beds.cpp): 2.6e-4 within 60 000 steps,
  // so some 1e-3 within these; an error that every impact made with one sign would pass the bound many times over.
  Scene scene = hard_case("pot", {"domain.gravity=[0,0,0]", "particles.count=24", "particles.speed=0.5",
                                  "contact.grain-grain.sliding=0", "contact.grain-grain.rolling=0",
                                  "contact.grain-grain.damping=0", "particles.region.z=[0, 0.04]"});
  scene.walls[0].profile = {{0.02, 0}, {0.02, 0.04}, {0, 0.04}};
  Trial t(scene);
  t.run_steps(1000000);
  t.check_sound();
  CHECK(t.dissipated() == 0);
  const double drift = t.step.energies(t.state).total() / t.begin.total() - 1;
  CHECK(std::fabs(drift) < 3e-3);
  write_row("hard", "09b", {"the same can, one run of 10^6 steps", "energy kept", "drift " + text("%.1e", drift)});
}

TEST_CASE("hard: ten thousand grains fall on ten thousand", "[hard][large]") {
  Scene scene = hard_case("pot", {"particles.count=20000", "particles.region.r=[0, 0.075]",
                                  "particles.region.z=[0, 0.7]", "time.step=2.26e-5"});
  for (WallDescription& wall : scene.walls)
    for (Eigen::Vector2d& point : wall.profile) point = {point.x() > 0 ? 0.075 : 0.0, point.y() > 0 ? 2.0 : 0.0};
  Trial t(scene);
  Particles& p = t.state.particles;  // the upper half waits half a metre higher, and falls at 3 m/s
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i)
    if (p.position.z[i] > 0.35) p.position.z[i] += 0.5, p.velocity.z[i] = -3;
  t.state.contacts = {};
  t.step.start(t.state, t.dt);
  t.begin = t.step.energies(t.state);
  t.run(0.6);
  t.check_sound();
  CHECK(t.unexplained() < 0.03);
  write_row("hard", "30",
            {"10 000 grains dropped on 10 000", "nothing is lost, budget closed",
             "residual " + text("%.2f", 100 * t.unexplained()) + " % of the losses"});
}

TEST_CASE("hard: two million grains for a hundred steps", "[hard][large]") {
  Scene scene = hard_case("pot", {"particles.speed=0.5"});
  for (WallDescription& wall : scene.walls)
    for (Eigen::Vector2d& point : wall.profile) point = {point.x() > 0 ? 0.4 : 0.0, point.y() > 0 ? 1.4 : 0.0};
  RandomFill& fill = std::get<RandomFill>(scene.particles.grains);
  fill.count = 2000000;
  fill.r_high = 0.4;
  fill.z_high = 1.3;
  Trial t(scene);
  t.run_steps(100);
  t.check_sound();
  CHECK(t.state.particles.count() == 2000000);
  write_row("hard", "31",
            {"2 000 000 grains, 100 steps", "runs", text("%.0f", t.state.contacts.rows()) + " near pairs"});
}
