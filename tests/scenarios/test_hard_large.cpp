// test_hard_large.cpp: hard cases that take minutes: a heavy drop and two million grains.
#include "tests/support/known_answer.hpp"
#include "tests/support/scene_run.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("hard: ten thousand grains fall on ten thousand", "[hard][large]") {
  Scene scene = hard_case("pot", {"particles.count=20000", "particles.region.r=[0, 0.075]",
                                  "particles.region.z=[0, 0.7]", "time.step=2.26e-5"});
  for (WallDescription& wall : scene.walls)
    for (Eigen::Vector2d& point : wall.profile) point = {point.x() > 0 ? 0.075 : 0.0, point.y() > 0 ? 2.0 : 0.0};
  SceneRun t(scene);
  Particles& p = t.state.particles;  // the upper half waits half a metre higher, and falls at 3 m/s
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i)
    if (p.position.z[i] > 0.35) p.position.z[i] += 0.5, p.velocity.z[i] = -3;
  t.state.contacts = {};
  t.step.start(t.state, t.dt);
  t.begin = t.step.energies(t.state);
  t.run(0.6);
  t.check_sound();
  CHECK(t.unexplained() < 0.03);
  write_row("hard cases", "30",
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
  SceneRun t(scene);
  t.run_steps(100);
  t.check_sound();
  CHECK(t.state.particles.count() == 2000000);
  write_row("hard cases", "31",
            {"2 000 000 grains, 100 steps", "runs", text("%.0f", t.state.contacts.rows()) + " near pairs"});
}
