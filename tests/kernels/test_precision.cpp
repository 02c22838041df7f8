// test_precision.cpp: what mixed precision changes, and how little.
#include "core/random.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

Scene mixed(Scene s) {
  s.run.precision = Precision::mixed;
  return s;
}

/// A grid of grains that overlap a little and move at random. `sizes`: of several radii; `materials`: 1 or 2;
/// `scale`: all lengths times this, all speeds alike.
std::vector<Grain> crowd(bool sizes, int materials, double scale = 1) {
  constexpr int side = 14;
  RandomStream random(4, 0);
  std::vector<Grain> grains;
  for (int i = 0; i < side * side * side; ++i) {
    const Vec3 cell{static_cast<double>(i % side), static_cast<double>(i / side % side),
                    static_cast<double>(i / side / side)};
    const auto some = [&](double size) {
      return Vec3{random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
    };
    const double radius = sizes ? R * random.uniform(0.97, 1.03) : R;
    const Vec3 place = 0.99 * d * cell + some(0.02 * d);
    grains.push_back({scale * radius, scale * place, some(0.1), some(20 / scale), i % materials});
  }
  return grains;
}

Scene materials(int kinds, ContactLaw law) {
  Scene s = plain_scene(1e7, 0.3, 3800);
  if (kinds == 2) s.materials.push_back({"other", 2500, 2e7, 0.2});
  s.interactions = PairTable<Interaction>(kinds);
  for (int a = 0; a < kinds; ++a) {
    for (int b = 0; b <= a; ++b) {
      Interaction& c = s.interactions(a, b);
      c.sliding = 0.4 + 0.1 * (a + b);
      c.rolling = 1e-4;
      c.damping_normal = 0.2;
      c.damping_tangential = 0.3;
    }
  }
  s.contact.law = law;
  s.contact.normal_stiffness = 5e3;
  s.contact.tangential_ratio = 2.0 / 7.0;
  return s;
}

/// The forces of this moment, of a scene's own precision, from a state that either precision may have left.
State with_forces(const Scene& scene, State state) {
  TimeStep(scene, state).start(state, 1e-6);
  return state;
}

}  // namespace

TEST_CASE("a shallow overlap far from the origin keeps its digits in mixed precision", "[precision]") {
  // Hertz: 4/3 E* sqrt(R* dn) dn. Lengths in single precision would miss an overlap of 1e-6 d by a tenth.
  const double young = 1e7 / (2 * (1 - 0.3 * 0.3)), R_first = R, R_second = 1.4 * R;
  const double R_effective = R_first * R_second / (R_first + R_second);
  for (const double overlap : {1e-2 * d, 1e-4 * d, 1e-6 * d}) {
    const Vec3 along{2.0 / 7, 3.0 / 7, 6.0 / 7}, place{0.31, -0.17, 1.3};
    Experiment e(mixed(plain_scene(1e7, 0.3, 3800)),
                 {{R_first, place, {}, {}}, {R_second, place + (R_first + R_second - overlap) * along, {}, {}}},
                 1e-6);
    const double force = 4.0 / 3.0 * young * std::sqrt(R_effective * overlap) * overlap;
    const Vec3 f = e.state.particles.force.get(e.slot(1));
    CHECK(norm(f - force * along) < 1e-6 * force);
    CHECK(norm(f + e.state.particles.force.get(e.slot(0))) == 0);
  }
}

TEST_CASE("forces in mixed precision are those in double to six digits", "[precision]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    for (const auto& [sizes, kinds] : {std::pair(false, 1), std::pair(true, 1), std::pair(true, 2)}) {
      for (const RollingVelocity rolling : {RollingVelocity::own, RollingVelocity::relative}) {
        CAPTURE(static_cast<int>(law), sizes, kinds, static_cast<int>(rolling));
        Scene scene = materials(kinds, law);
        scene.contact.rolling_velocity = rolling;
        Experiment e(scene, crowd(sizes, kinds), 1e-6);
        e.run(50);  // histories grow, some slide
        const State exact = with_forces(scene, e.state), narrow = with_forces(mixed(scene), e.state);
        double scale = 0, worst = 0, worst_torque = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(exact.particles.count()); ++i) {
          const Particles &a = exact.particles, &b = narrow.particles;
          REQUIRE(a.id[i] == b.id[i]);
          scale = std::max(scale, norm(a.force.get(i)));
          worst = std::max(worst, norm(a.force.get(i) - b.force.get(i)));
          worst_torque = std::max(worst_torque, norm(a.torque.get(i) - b.torque.get(i)) / R);
        }
        CHECK(scale > 0);
        CHECK(worst < 2e-6 * scale);
        CHECK(worst_torque < 2e-6 * scale);
        CHECK(worst > 0);  // it was computed in another width
      }
    }
  }
}

TEST_CASE("mixed precision computes powder as it does gravel", "[precision]") {
  // Masses and inertias of 5 um grains are 1e-12 and 1e-24 in SI units; a float ends at 1e-38.
  constexpr double scale = 1e-3;
  for (const auto& [rolling, model] : {std::pair(RollingVelocity::own, RollingModel::constant_torque),
                                       std::pair(RollingVelocity::relative, RollingModel::constant_torque),
                                       std::pair(RollingVelocity::own, RollingModel::elastic_plastic_spring)}) {
    CAPTURE(static_cast<int>(rolling), static_cast<int>(model));
    Scene scene = materials(2, ContactLaw::mindlin_deresiewicz);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b <= a; ++b) scene.interactions(a, b).rolling *= scale;
    scene.contact.rolling_velocity = rolling;
    scene.contact.rolling = model;
    Experiment exact(scene, crowd(true, 2, scale), scale * 1e-6),
        narrow(mixed(scene), crowd(true, 2, scale), scale * 1e-6);
    exact.run(50);
    narrow.run(50);
    double scale_of_spin = 0, worst = 0;
    for (int id = 0; id < static_cast<int>(exact.state.particles.count()); ++id) {
      scale_of_spin = std::max(scale_of_spin, norm(exact.w(id)));
      worst = std::max(worst, norm(exact.w(id) - narrow.w(id)));
    }
    CHECK(worst < 1e-5 * scale_of_spin);
    CHECK(narrow.state.energy.rolling == Approx(exact.state.energy.rolling).epsilon(1e-4));
  }
}

TEST_CASE("mixed precision keeps momentum and books energy as double does", "[precision]") {
  const Scene scene = materials(2, ContactLaw::mindlin_deresiewicz);
  Experiment exact(scene, crowd(true, 2), 2e-6), narrow(mixed(scene), crowd(true, 2), 2e-6);
  const auto momentum = [](const State& s) {
    Vec3 sum;
    double size = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.particles.count()); ++i) {
      sum += s.particles.mass[i] * s.particles.velocity.get(i);
      size += s.particles.mass[i] * norm(s.particles.velocity.get(i));
    }
    return std::pair(sum, size);
  };
  const auto [before, size] = momentum(narrow.state);
  exact.run(2000);
  narrow.run(2000);
  CHECK(narrow.state.energy.normal_damping > 0.1 * narrow.begin.kinetic);  // they met
  CHECK(norm(momentum(narrow.state).first - before) < 1e-6 * size);
  for (const auto loss : {&EnergyLedger::normal_damping, &EnergyLedger::tangential_damping, &EnergyLedger::sliding,
                          &EnergyLedger::rolling})
    CHECK(narrow.state.energy.*loss == Approx(exact.state.energy.*loss).epsilon(1e-4));
  CHECK(std::fabs(narrow.residual() - exact.residual()) < 1e-5 * exact.begin.kinetic);
}

TEST_CASE("what contacts see goes to single precision and back without another rounding", "[precision]") {
  SeenTable table;
  table.resize(2);
  const Seen seen{{0.1, 0.2, 0.3}, 0.0025, {1.0 / 3, -2.0 / 3, 1e-7}, 1.0 / 7, {11.1, 0, -1e-20}, 3};
  table.set(1, seen);
  table.set_precision(Precision::mixed);
  const Seen narrow = table.get(1);
  CHECK(narrow.position.y == 0.2);  // places and radii stay what they are
  CHECK(narrow.radius == 0.0025);
  CHECK(narrow.velocity.x == static_cast<float>(1.0 / 3));
  CHECK(narrow.mass == static_cast<float>(1.0 / 7));
  table.set_precision(Precision::double_precision);
  table.set_precision(Precision::mixed);
  const Seen again = table.get(1);
  CHECK(norm(again.velocity - narrow.velocity) == 0);
  CHECK(norm(again.angular_velocity - narrow.angular_velocity) == 0);
}
