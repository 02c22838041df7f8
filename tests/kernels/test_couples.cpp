// test_couples.cpp: rolling resistance as couples in contacts, and the total Coulomb limit: known answers.
#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "kernels/laws/rolling.hpp"
#include "kernels/laws/total_coulomb.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double g = 9.81, R = 0.0025;

Scene on_plate(Scene s, double tilt = 0) {
  add_wall(s, "plate", {{0, 0}, {10, 0}});
  s.domain.gravity = {g * std::sin(tilt), 0, -g * std::cos(tilt)};
  return s;
}

double hertz_stiffness_factor(const Scene& s) {  // (4/3) E* sqrt(R), N/m^(3/2)
  const Material& m = s.materials[0];
  return 4.0 / 3.0 * m.young / (2 * (1 - m.poisson * m.poisson)) * std::sqrt(R);
}
double resting_overlap(const Scene& s, double tilt = 0) {
  return std::pow(sphere_mass(R, s.materials[0].density) * g * std::cos(tilt) / hertz_stiffness_factor(s),
                  2.0 / 3.0);
}

}  // namespace

TEST_CASE("relative: the couple is mu_r |f_n|, or half of what stops the pair within the step", "[couples]") {
  const RollingInput fast{{3, 0, 4}, {0, 0, 1}, 2.0, 0, 1e-4, 1e-8, 0};
  CHECK(norm(relative_couple(fast, 1e-9) - Vec3{-1.2e-4, 0, -1.6e-4}) < 1e-18);
  const RollingInput slow{{3e-5, 0, 4e-5}, {0, 0, 1}, 2.0, 0, 1e-4, 1e-8, 0};
  CHECK(norm(relative_couple(slow, 1e-5) - (-0.5 * 1e-8 / 1e-5) * slow.spin) < 1e-18);
  CHECK(norm(relative_couple(RollingInput{{}, {0, 0, 1}, 2.0, 0, 1e-4, 1e-8, 0}, 1e-5)) == 0);
}

TEST_CASE(
    "rolling spring: it grows with the spin across the normal alone, is damped below its limit, and stays there",
    "[couples]") {
  // k_r = 2.25 k_n mu_r^2 = 2.25e-4 N m, critical damping 2 sqrt(I k_r) = 3e-6 N m s, limit mu_r |f_n| = 2e-4 N m
  const RollingInput in{{3, 0, 4}, {0, 0, 1}, 2.0, 1e4, 1e-4, 1e-8, 0.3};
  const double dt = 1e-6, half_step = 0.5 * dt * 2.25e-4 * 3;
  const RollingSpring below = rolling_spring(in, {5e-5, -1e-5, 0}, dt);
  CHECK(norm(below.couple - Vec3{5e-5 - half_step - 0.3 * 3e-6 * 3, -1e-5, 0}) < 1e-18);
  CHECK(norm(below.moment - Vec3{5e-5 - 2 * half_step, -1e-5, 0}) < 1e-18);
  const RollingSpring beyond = rolling_spring(in, {half_step - 1.2e-4 * 3, 1.6e-4 * 3, 0}, dt);
  CHECK(norm(beyond.couple - Vec3{-1.2e-4, 1.6e-4, 0}) < 1e-17);
  CHECK(norm(beyond.moment - Vec3{-1.2e-4 - half_step, 1.6e-4, 0}) < 1e-17);
}

TEST_CASE("relative: a sphere that rolls on a plate stops as with the limiter", "[couples]") {
  Scene s = hopper_material();
  s.contact.rolling_velocity = RollingVelocity::relative;
  s = on_plate(s);
  const double u = 0.1, l = R - resting_overlap(s), mu_r = s.interactions(0, 0).rolling;
  Experiment e(s, {{R, {1.5, 2.5, l}, {u, 0, 0}, {0, u / l, 0}}}, 1e-5);
  const double deceleration = mu_r * g * l / (0.4 * R * R + l * l), x0 = e.x(0).x;
  e.run(15000);
  CHECK(e.v(0).x == Approx(u - deceleration * e.state.time).epsilon(1e-3));
  REQUIRE(e.run_until([&] { return norm(e.w(0)) < 1e-3 * u / l; }, 100000));
  CHECK(e.state.time == Approx(0.3568).epsilon(5e-3));
  CHECK(e.x(0).x - x0 == Approx(17.84e-3).epsilon(5e-3));
  e.run(20000);
  CHECK(norm(e.w(0)) < 1e-9);
}

TEST_CASE("relative: a pair of spheres keeps its angular momentum, and against their own spins it does not",
          "[couples]") {
  for (const RollingVelocity velocity : {RollingVelocity::relative, RollingVelocity::own}) {
    Scene s = hopper_material();
    s.contact.rolling_velocity = velocity;
    Experiment e(s,
                 {{R, {0, 0, 0}, {0.1, 0, 0.02}, {10, 20, -30}},
                  {1.4 * R, {2.39 * R, 0.1 * R, 0}, {-0.05, 0.03, 0}, {-5, 2, 40}}},
                 1e-6);
    const auto angular = [&] {
      Vec3 sum;
      for (int i = 0; i < 2; ++i)
        sum += e.mass(i) * cross(e.x(i), e.v(i)) +
               sphere_inertia(e.mass(i), e.state.particles.radius[e.slot(i)]) * e.w(i);
      return sum;
    };
    const Vec3 before = angular();
    e.run(4000);
    CHECK(e.touching() == 0);
    const double change = norm(angular() - before) / norm(before);
    if (velocity == RollingVelocity::relative) {
      CHECK(change < 1e-12);
    } else {
      CHECK(change > 1e-4);
    }
  }
}

TEST_CASE(
    "rolling spring: on a slope it holds by an angle of moment over stiffness, and gives way beyond its limit",
    "[couples]") {
  for (const double part : {0.5, 1.1}) {
    Scene s = hopper_material();
    s.contact.rolling = RollingModel::elastic_plastic_spring;
    const double mu_r = s.interactions(0, 0).rolling;
    const double tilt = std::atan(part * mu_r / (R - resting_overlap(s)));
    s = on_plate(s, tilt);
    const double dn = resting_overlap(s, tilt), l = R - dn, mass = sphere_mass(R, 3800);
    Experiment e(s, {{R, {1.5, 2.5, l}, {}, {}}}, 5e-6);
    const double x0 = e.x(0).x, moment = mass * g * std::sin(tilt) * l;
    const double stiffness = 2.25 * hertz_stiffness_factor(s) * std::sqrt(dn) * mu_r * mu_r;
    if (part < 1) {
      e.run(200000);
      // It rolls until the spring carries the moment; the contact's own creep adds its elastic displacement.
      CHECK(e.x(0).x - x0 == Approx(l * moment / stiffness).epsilon(0.05));
      CHECK(norm(e.w(0)) < 1e-6);
    } else {
      e.run(40000);
      const double before = e.v(0).x;
      e.run(40000);
      const double rate = g * (std::sin(tilt) - mu_r / l * std::cos(tilt)) / (1 + 0.4 * R * R / (l * l));
      CHECK(e.v(0).x - before == Approx(rate * 0.2).epsilon(5e-3));
    }
  }
}

TEST_CASE("rolling spring: a rolling sphere is braked by the limit moment and comes to rest", "[couples]") {
  Scene s = hopper_material();
  s.contact.rolling = RollingModel::elastic_plastic_spring;
  s = on_plate(s);
  const double u = 0.1, l = R - resting_overlap(s), mu_r = s.interactions(0, 0).rolling;
  Experiment e(s, {{R, {1.5, 2.5, l}, {u, 0, 0}, {0, u / l, 0}}}, 1e-5);
  const double deceleration = mu_r * g * l / (0.4 * R * R + l * l);
  e.run(1000);  // the spring is loaded after a small angle
  const double v0 = e.v(0).x, t0 = e.state.time;
  e.run(15000);
  CHECK(e.v(0).x == Approx(v0 - deceleration * (e.state.time - t0)).epsilon(2e-3));
  e.run(60000);
  CHECK(std::fabs(e.v(0).x) < 1e-5);
  CHECK(std::fabs(e.residual()) < 0.02 * e.begin.total());
}

TEST_CASE("coulomb = total: elastic and viscous force together stay within mu |f_cn|", "[couples]") {
  const Material m{"grain", 3800, 1e7, 0.3};
  Interaction pair;
  pair.sliding = 0.5;
  pair.damping_normal = pair.damping_tangential = 0.3;
  const auto c = MindlinDeresiewicz::prepare(m, m, pair, {});
  ContactInput in{1e-5, 0.00125, 1e-4, 0.1, {2.0, 0, 0}, {1e-7, 2e-7, 0}};
  const ContactResponse printed = MindlinDeresiewicz::respond(c, in),
                        limited = TotalCoulomb<MindlinDeresiewicz>::respond(c, in);
  CHECK(norm(printed.tangential) > 1.2 * 0.5 * printed.elastic_normal);
  CHECK(norm(limited.tangential) == Approx(0.5 * printed.elastic_normal).epsilon(1e-12));
  CHECK(norm(cross(limited.tangential, printed.tangential)) < 1e-12 * dot(printed.tangential, printed.tangential));
  in.tangential_velocity = {1e-3, 0, 0};
  CHECK(norm(TotalCoulomb<MindlinDeresiewicz>::respond(c, in).tangential -
             MindlinDeresiewicz::respond(c, in).tangential) == 0);
}

namespace {

// Two grains of radii R and 1.4 R, pressed together by an overlap that does not change: nothing holds them, but
// they spin so slowly (or are so heavy) that the spins have their answer long before the grains have moved.
constexpr double dn = 2.5e-5, radius_ratio = 1.4;  // m, -
const Vec3 normal = (1 / 7.0) * Vec3{2, 3, 6};

struct Pressed {
  double load, inertia[2];  // N, kg m2
  std::vector<Grain> grains;

  Pressed(const Scene& s, Vec3 wi, Vec3 wj, Vec3 vj = {}) {
    load = hertz_stiffness_factor(s) * std::sqrt(radius_ratio / (1 + radius_ratio)) * std::pow(dn, 1.5);
    for (int k = 0; k < 2; ++k) {
      const double radius = k == 0 ? R : radius_ratio * R;
      inertia[k] = 0.4 * sphere_mass(radius, s.materials[0].density) * radius * radius;
    }
    grains = {{R, {0, 0, 0}, {}, wi}, {radius_ratio * R, ((1 + radius_ratio) * R - dn) * normal, vj, wj}};
  }
};

}  // namespace

TEST_CASE("limiter: each of two grains that roll on each other loses spin at mu_r |f_n| / I, until it is zero",
          "[couples]") {
  const Scene s = hopper_material(0);
  const double mu_r = s.interactions(0, 0).rolling, li = R - 0.5 * dn, lj = radius_ratio * R - 0.5 * dn;
  const Vec3 wi = 1e-3 / std::sqrt(13.0) * Vec3{3, -2, 0}, wj = (-li / lj) * wi;  // perpendicular to the normal
  const Pressed pair(s, wi, wj);
  const double rate[] = {mu_r * pair.load / pair.inertia[0], mu_r * pair.load / pair.inertia[1]};
  const double stop[] = {norm(wi) / rate[0], norm(wj) / rate[1]}, dt = stop[0] / 1000;
  Experiment e(s, pair.grains, dt);
  e.run(500);
  CHECK(norm(e.w(0) - 0.5 * wi) < 1e-5 * norm(wi));
  CHECK(norm(e.w(1) - (1 - 500 * dt / stop[1]) * wj) < 1e-5 * norm(wj));
  e.run(490);
  CHECK(norm(e.w(0)) > 0);
  e.run(20);
  CHECK(norm(e.w(0)) == 0);
  e.run(static_cast<int>(0.99 * stop[1] / dt) - 1010);
  CHECK(norm(e.w(0)) == 0);
  CHECK(norm(e.w(1)) > 0);
  e.run(static_cast<int>(0.02 * stop[1] / dt));
  CHECK(norm(e.w(1)) == 0);
  const double spun = 0.5 * (pair.inertia[0] * dot(wi, wi) + pair.inertia[1] * dot(wj, wj));
  CHECK(e.state.energy.rolling == Approx(spun).epsilon(1e-4));
}

TEST_CASE("relative: two grains end with the spin they have in common, braked by mu_r |f_n|", "[couples]") {
  Scene s = hopper_material(0);
  s.contact.rolling_velocity = RollingVelocity::relative;
  const double mu_r = s.interactions(0, 0).rolling;
  const Vec3 wi{1e-3, -2e-3, 0.5e-3}, wj{-0.3e-3, 0.4e-3, 2e-3}, along = (1 / norm(wi - wj)) * (wi - wj);
  const Pressed pair(s, wi, wj);
  const double moment = mu_r * pair.load, Ii = pair.inertia[0], Ij = pair.inertia[1];
  const double stop = norm(wi - wj) / (moment / Ii + moment / Ij), dt = stop / 1000;
  Experiment e(s, pair.grains, dt);
  REQUIRE(e.state.contacts.rows() == 1);
  CHECK(norm(e.state.contacts.couple.get(0) + moment * along) < 1e-9 * moment);
  e.run(500);
  const double size = norm(wi - wj);
  CHECK(norm(e.w(0) - (wi - (moment / Ii * 500 * dt) * along)) < 1e-5 * size);
  CHECK(norm(e.w(1) - (wj + (moment / Ij * 500 * dt) * along)) < 1e-5 * size);
  e.run(1000);
  const Vec3 common = (1 / (Ii + Ij)) * (Ii * wi + Ij * wj);
  CHECK(norm(e.w(0) - common) < 1e-5 * size);
  CHECK(norm(e.w(1) - common) < 1e-5 * size);
  CHECK(e.state.energy.rolling == Approx(0.5 * Ii * Ij / (Ii + Ij) * size * size).epsilon(2e-3));
}

TEST_CASE("rolling spring: the couple of two grains is k_r times the angle they rolled, at most mu_r |f_n|",
          "[couples]") {
  // k_r = 2.25 k_n mu_r^2, so the limit is reached after dn / (2.25 mu_r), here 0.11 rad; spins about the normal
  // do not count.
  Scene s = hopper_material(0);
  s.materials[0].density = 1e15;
  s.interactions(0, 0).sliding = 0;  // no other torque
  s.contact.rolling = RollingModel::elastic_plastic_spring;
  s.contact.rolling_damping = 0;
  const double mu_r = s.interactions(0, 0).rolling, rate = 10, dt = 1e-5;  // m, rad/s, s
  const Vec3 along = 1 / std::sqrt(13.0) * Vec3{3, -2, 0}, twist = 2.0 * normal;
  const Pressed pair(s, (0.3 * rate) * along + twist, (-0.7 * rate) * along - twist);
  const double limit = mu_r * pair.load, stiffness = 2.25 * (pair.load / dn) * mu_r * mu_r;
  Experiment e(s, pair.grains, dt);
  const auto check = [&](double moment) {
    CHECK(norm(e.state.contacts.couple.get(0) + moment * along) < 2e-3 * limit);
    CHECK(norm(e.state.particles.torque.get(e.slot(0)) + moment * along) < 2e-3 * limit);
    CHECK(norm(e.state.particles.torque.get(e.slot(1)) - moment * along) < 2e-3 * limit);
  };
  e.run(600);
  check(stiffness * 600 * dt * rate);
  e.run(2400);
  check(limit);
  CHECK(e.state.energy.rolling > 0);
  for (const int id : {0, 1}) e.state.particles.angular_velocity.set(e.slot(id), -e.w(id));
  e.run(500);
  check(limit - stiffness * 500 * dt * rate);
  e.run(3000);
  check(-limit);
}

TEST_CASE("relative, rolling spring: two grains that turn as one rigid body feel no couple", "[couples]") {
  for (const bool spring : {false, true}) {
    Scene s = hopper_material(0);
    s.interactions(0, 0).sliding = 0;  // no other torque
    if (spring) s.contact.rolling = RollingModel::elastic_plastic_spring;
    s.contact.rolling_velocity = RollingVelocity::relative;
    const Vec3 w{3, -20, 7};
    Experiment e(s, Pressed(s, w, w, cross(w, ((1 + radius_ratio) * R - dn) * normal)).grains, 1e-8);
    e.run(200);
    REQUIRE(e.touching() == 1);
    CHECK(norm(e.state.contacts.couple.get(0)) == 0);
    CHECK(norm(e.w(0) - w) == 0);
    CHECK(norm(e.w(1) - w) == 0);
    CHECK(e.state.energy.rolling == 0);
  }
}
