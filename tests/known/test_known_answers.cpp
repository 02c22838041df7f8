// test_known_answers.cpp: another program's log, a column at rest, rolling.
#include "tests/support/impact.hpp"
#include "tests/support/known_answer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double g = 9.81;

}  // namespace

TEST_CASE("a damped impact follows another program's log", "[known]") {
  // LAMMPS (4 Feb 2025), example granular/in.restitution: hertz/material 1e6 0.8 0.4, damping coeff_restitution,
  // time step 1 ns. Two spheres of 4 mm, centres 4.16 mm apart, at +-1 m/s: they touch at 0.08 ms.
  struct Row {
    double time, speed, force;
  };  // ms, m/s, N: those of the lower sphere
  Scene scene = plain_scene(1e6, 0.4, 2500);
  scene.contact.law = ContactLaw::hertz_mindlin;
  scene.interactions(0, 0).restitution = 0.8;
  const double dt = 1e-8;
  Experiment e(scene, {{0.002, {0, 0, 0.04}, {0, 0, 1}, {}}, {0.002, {0, 0, 0.04416}, {0, 0, -1}, {}}}, dt);
  const char* source = "LAMMPS (4 Feb 2025), in.restitution";
  for (const Row& row :
       {Row{0.1, 0.9944753, -0.032005131}, Row{0.3, 0.69263807, -0.22744912}, Row{0.5, 0.0002758068, -0.31403982},
        Row{0.7, -0.61755887, -0.17548034}, Row{0.9, -0.80809791, -0.00035001143},
        Row{0.95, -0.80241211, 0.015295834}, Row{1.0, -0.79999999, 0}}) {
    while (e.state.step < std::lround(row.time * 1e-3 / dt)) e.run(1);
    const std::string when = text("05%.2f", row.time), at = text("damped impact at %.2f ms: ", row.time);
    CHECK(KnownAnswer(when + "a", at + "speed", source, Measure::absolute, "m/s")
              .add(e.v(0).z, row.speed)
              .within(1e-6));
    CHECK(KnownAnswer(when + "b", at + "force", source, Measure::absolute, "N")
              .add(e.state.particles.force.get(e.slot(0)).z, row.force)
              .within(1e-6));
  }
}

TEST_CASE("a column of ten spheres at rest", "[known]") {
  // Each contact carries what lies above it: (4/3) E* sqrt(R*) dn^(3/2); below the lowest sphere R* = R, else R/2.
  const double R = 0.0025, dt = 2e-5;
  const int count = 10;
  Scene s = plain_scene(1e7, 0.3, 3800, 0, 0.3);
  s.domain.gravity = {0, 0, -g};
  add_wall(s, "floor", {{0, 0}, {1, 0}});
  std::vector<Grain> grains;
  for (int k = 0; k < count; ++k) grains.push_back({R, {0.3, 0.2, (2 * k + 1) * R}, {}, {}});
  Experiment e(s, grains, dt);
  e.run(150000);
  double height = 0;
  KnownAnswer answer("06a", "column of ten spheres: every height", "Hertz, weight above each contact",
                     Measure::relative, "mm");
  for (int k = 0; k < count; ++k) {
    const double weight = (count - k) * sphere_mass(R, 3800) * g, young = 1e7 / (2 * (1 - 0.09));
    const double overlap = std::pow(weight / (4.0 / 3.0 * young * std::sqrt(k == 0 ? R : R / 2)), 2.0 / 3.0);
    height += (k == 0 ? R : 2 * R) - overlap;
    answer.add(e.x(k).z * 1e3, height * 1e3);
    CHECK(norm(e.v(k)) < 1e-12);
  }
  CHECK(answer.within(1e-10));
  CHECK(
      KnownAnswer("06b", "column of ten spheres: lowest centre", "closed form, as printed", Measure::relative, "mm")
          .add(e.x(0).z * 1e3, 2.483568)
          .within(3e-7));
  CHECK(KnownAnswer("06c", "column of ten spheres: highest centre", "closed form, as printed", Measure::relative,
                    "mm")
            .add(e.x(count - 1).z * 1e3, 47.37028)
            .within(3e-7));
}

TEST_CASE("rolling friction brakes a sphere by the published rate: Wensrich & Katterfeld (2012)", "[known]") {
  // Rolling at 0.15 m/s on a plate, E 2.6e7, nu 0.203, rho 1, mu_r = 0.2 R as a length: dw/dt = (5/7) 0.2 g / R.
  const double R = 0.0026, u = 0.15, dt = 5e-7;
  Scene s = plain_scene(2.6e7, 0.203, 1, 0.5, 0.3);
  s.interactions(0, 0).rolling = 0.2 * R;
  s.domain.gravity = {0, 0, -g};
  add_wall(s, "plate", {{0, 0}, {1, 0}});
  const double young = 2.6e7 / (2 * (1 - 0.203 * 0.203));
  const double overlap = std::pow(sphere_mass(R, 1) * g / (4.0 / 3.0 * young * std::sqrt(R)), 2.0 / 3.0);
  Experiment e(s, {{R, {0.3, 0.2, R - overlap}, {u, 0, 0}, {0, u / R, 0}}}, dt);
  e.run(40000);
  const double before = e.w(0).y, begin = e.state.time;
  e.run(100000);
  CHECK(e.w(0).y > 10);  // it still rolls
  CHECK(KnownAnswer("07a", "rolling friction: angular deceleration",
                    "Wensrich & Katterfeld (2012), Kratos benchmark 12", Measure::relative, "1/s2")
            .add((before - e.w(0).y) / (e.state.time - begin), 539.01)
            .within(1e-4));
  REQUIRE(e.run_until([&] { return norm(e.w(0)) == 0; }, 1000000));
  CHECK(KnownAnswer("07b", "rolling friction: time to rest", "the same rate from u / R", Measure::relative, "s")
            .add(e.state.time, u / R / 539.01)
            .within(2e-3));
}
