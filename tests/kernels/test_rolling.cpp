// test_rolling.cpp: slipping, rolling and resting on a plate, against the equations of a rigid sphere.
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/known_answer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double g = 9.81;

/// Overlap [m] at which the plate carries the grain's weight, and the lever arm R - dn there.
double resting_overlap(const Scene& s, double radius) {
  const Material& m = s.materials[0];
  const double young = m.young / (2 * (1 - m.poisson * m.poisson));
  return std::pow(sphere_mass(radius, m.density) * g / (4.0 / 3.0 * young * std::sqrt(radius)), 2.0 / 3.0);
}

Scene on_plate(Scene s, double tilt = 0) {
  add_wall(s, "plate", {{0, 0}, {10, 0}});
  s.domain.gravity = {g * std::sin(tilt), 0, -g * std::cos(tilt)};
  return s;
}

Grain resting(const Scene& s, double radius, Vec3 v = {}, Vec3 w = {}) {
  return {radius, {1.5, 2.5, radius - resting_overlap(s, radius)}, v, w};
}

}  // namespace

TEST_CASE("slip to roll: a sliding sphere ends rolling at 5/7 of its speed", "[rolling]") {
  KnownAnswer end("08a", "slip to roll, mu 0.2 ... 1: speed at the end", "rigid sphere, u0 / (1 + 2 R^2 / (5 l^2))",
                  Measure::relative, "m/s");
  KnownAnswer time("08b", "slip to roll, mu 0.2 ... 1: time until it rolls",
                   "rigid sphere, slip / (mu g (1 + 5 l^2 / (2 R^2)))", Measure::relative, "s");
  for (const double mu : {0.2, 0.4, 0.6, 0.8, 1.0}) {
    const Scene s = on_plate(plain_scene(1e7, 0.3, 3800, mu, 0.3));
    const double R = 0.0025, u0 = 0.2, l = R - resting_overlap(s, R), dt = 2e-6;
    Experiment e(s, {resting(s, R, {u0, 0, 0})}, dt);
    const auto slip = [&] { return e.v(0).x - l * e.w(0).y; };
    e.run(50);  // friction saturates; tangential damping has braked the grain a little by then
    CHECK(slip() == Approx(u0).epsilon(0.1));
    const double expected_time = e.state.time + slip() / (mu * g * (1 + 2.5 * l * l / (R * R)));
    CHECK(expected_time == Approx(2 * u0 / (7 * mu * g)).epsilon(0.1));
    double rolls_at = 0;
    e.run_until(
        [&] {
          if (rolls_at == 0 && slip() <= 1e-3 * u0) rolls_at = e.state.time;
          return e.state.time > 2 * expected_time;
        },
        1000000);
    CHECK(e.w(0).y == Approx(e.v(0).x / l).epsilon(2e-4));
    end.add(e.v(0).x, u0 / (1 + 2 * R * R / (5 * l * l)));
    time.add(rolls_at, expected_time);
  }
  CHECK(end.within(2e-4));
  CHECK(time.within(5e-3));
}

TEST_CASE("rolling friction stops a rolling sphere after the time and way of a constant torque, and it stays",
          "[rolling]") {
  struct Row {
    Scene scene;
    double radius, time, way;
  };
  const char* source = "constant torque, (5/7) (mu_r / R) g";
  KnownAnswer time("08c", "rolling stop, hopper and pile sphere: time", source, Measure::relative, "s");
  KnownAnswer way("08d", "rolling stop, hopper and pile sphere: distance", source, Measure::relative, "m");
  for (const Row& row :
       {Row{hopper_material(), 0.0025, 0.3568, 17.84e-3}, Row{pile_material(), 0.001, 0.1427, 7.136e-3}}) {
    const Scene s = on_plate(row.scene);
    const double R = row.radius, u = 0.1, l = R - resting_overlap(s, R), dt = 1e-5;
    Experiment e(s, {resting(s, R, {u, 0, 0}, {0, u / l, 0})}, dt);
    const double mu_r = s.interactions(0, 0).rolling;
    const double deceleration = mu_r * g * l / (0.4 * R * R + l * l);
    const double x0 = e.x(0).x;
    e.run(static_cast<int>(0.5 * row.time / dt));
    CHECK(e.v(0).x == Approx(u - deceleration * e.state.time).epsilon(1e-3));
    REQUIRE(e.run_until([&] { return norm(e.w(0)) == 0; }, 100000));
    time.add(e.state.time, row.time);
    way.add(e.x(0).x - x0, row.way);
    CHECK(u / deceleration == Approx(row.time).epsilon(5e-3));
    e.run(20000);
    CHECK(norm(e.w(0)) == 0);  // not small: zero
    CHECK(norm(e.v(0)) < 1e-12);
  }
  CHECK(time.within(5e-3));
  CHECK(way.within(5e-3));
}

TEST_CASE("a sphere rests on an incline up to atan(mu_r / R) and rolls beyond", "[rolling]") {
  KnownAnswer beyond("08e", "incline 1 % beyond mu_r / l: speed gained", "constant torque", Measure::relative,
                     "m/s");
  for (const auto& [scene, R, degrees] :
       {std::make_tuple(hopper_material(), 0.0025, 2.291), std::make_tuple(pile_material(), 0.001, 5.711)}) {
    const double mu_r = scene.interactions(0, 0).rolling;
    CHECK(std::atan(mu_r / R) * 180 / pi == Approx(degrees).margin(1e-3));
    const double l = R - resting_overlap(scene, R);
    for (const double factor : {0.99, 1.01}) {
      const double tilt = std::atan(factor * mu_r / l);
      const Scene s = on_plate(scene, tilt);
      const double dt = 5e-6;
      Experiment e(s, {resting(s, R)}, dt);
      e.run(20000);
      const double v_before = e.v(0).x, lost_before = e.state.energy.rolling;
      e.run(40000);
      const double rate = g * (std::sin(tilt) - mu_r / l * std::cos(tilt)) / (1 + 0.4 * R * R / (l * l));
      if (factor < 1) {
        CHECK(norm(e.w(0)) == 0);
        CHECK(std::fabs(e.v(0).x) < 1e-9);
        CHECK(e.state.energy.rolling == lost_before);  // what holds a grain at rest takes no energy
      } else {
        beyond.add(e.v(0).x - v_before, rate * 40000 * dt);
      }
    }
  }
  CHECK(beyond.within(1e-3));
}
