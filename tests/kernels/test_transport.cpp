// test_transport.cpp: the stored displacement and the moment of a rolling spring are carried along with its contact
// as with a rigid body.
#include "core/random.hpp"
#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "kernels/passes/evaluate_contacts.hpp"
#include "kernels/passes/evaluate_walls.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

using Law = MindlinDeresiewicz;

constexpr double R = 0.0025, overlap = 2e-5;  // m

Vec3 unit(Vec3 u) { return (1 / norm(u)) * u; }

/// u turned about the unit vector `axis` by `angle` [rad] (Rodrigues).
Vec3 turned(Vec3 u, Vec3 axis, double angle) {
  return std::cos(angle) * u + std::sin(angle) * cross(axis, u) + (1 - std::cos(angle)) * dot(axis, u) * axis;
}

/// Half of what the default law lets the displacement be: mu_s (2 - nu) / (2 (1 - nu)) dn.
double half_limit(const Scene& s) { return 0.5 * s.interactions(0, 0).sliding * (1.7 / 1.4) * overlap; }

/// The same of a rolling spring, whose limit is mu_r f_n.
double half_limit_moment(const Scene& s, Vec3 load) { return 0.5 * s.interactions(0, 0).rolling * norm(load); }

Scene stressed_scene(Friction friction) {
  Scene s = plain_scene(1e7, 0.3, 3800, 0.6, 0.3);
  if (friction == Friction::spring) {
    s.contact.rolling = RollingModel::elastic_plastic_spring;
    s.interactions(0, 0).rolling = 1e-4;
  }
  return s;
}

/// Two stressed grains turned by 90 degrees in `steps` steps as one rigid body, about `axis` through a third point,
/// with exact positions, velocities and spins. Returns how far the displacement, or with a rolling spring its
/// moment, ends from where the body takes it, relative to its size.
template <Friction friction>
double drift_of_pair(Vec3 axis, int steps) {
  constexpr bool rolls = friction == Friction::spring;
  const Scene s = stressed_scene(friction);
  const Vec3 n = unit({2, 3, 6}), about{0.01, -0.02, 0.005};
  const Vec3 places[] = {{0, 0, 0}, (2.4 * R - overlap) * n};
  Experiment e(s, {{R, places[0], {}, {}}, {1.4 * R, places[1], {}, {}}}, 1e-6);
  REQUIRE(e.state.contacts.rows() == 1);
  REQUIRE(e.state.contacts.first[0] == static_cast<Index>(e.slot(0)));
  Vec3Array& stored = rolls ? e.state.contacts.rolling_moment : e.state.contacts.history;
  const Vec3 stress =
      (rolls ? half_limit_moment(s, e.contact_force(0)) : half_limit(s)) * unit(cross(n, {1, 0, 0}));
  stored.set(0, stress);
  const Material& m = s.materials[0];
  const Law::Coefficients coefficients[] = {Law::prepare(m, m, s.interactions(0, 0), s.contact)};
  Particles& p = e.state.particles;
  const GeneralMix<Law, double> mix{coefficients};
  ReactionMap map;
  map_reactions(e.state, AxisRule::clamp, map);
  ForceSums sums;
  const double rate = 100, dt = 0.5 * pi / rate / steps;  // rad/s, s
  Vec3 before;
  for (int k = 0; k <= steps; ++k) {
    for (int id = 0; id < 2; ++id) {
      const Vec3 arm = turned(places[id] - about, axis, rate * k * dt);
      Seen seen = p.seen.get(e.slot(id));
      seen.position = about + arm;
      seen.velocity = rate * cross(axis, arm);
      seen.angular_velocity = rate * axis;
      p.seen.set(e.slot(id), seen);
    }
    evaluate_contacts<Law, friction, true>(mix, e.state, map, sums, k == 0 ? 0 : dt, 0);
    if (k == 0) before = sums.force(e.state.contacts.first[0]);
  }
  const double of_stress = norm(stored.get(0) - turned(stress, axis, 0.5 * pi)) / norm(stress);
  CHECK(norm(sums.force(e.state.contacts.first[0]) - turned(before, axis, 0.5 * pi)) <
        2 * (of_stress + 1e-9) * norm(before));
  return of_stress;
}

/// The same for a grain on a plate that spin together about the plate's axis, which is the normal.
template <Friction friction>
double drift_on_plate(int steps) {
  constexpr bool rolls = friction == Friction::spring;
  Scene s = stressed_scene(friction);
  add_wall(s, "plate", {{0, 0}, {0.1, 0}});
  const double rate = 100, dt = 0.5 * pi / rate / steps;
  s.walls[0].spin = rate;
  const Vec3 place{0.03, 0.02, R - overlap}, axis{0, 0, 1};
  Experiment e(s, {{R, place, {}, {}}}, 1e-6);
  REQUIRE(e.touching_walls() == 1);
  Particles& p = e.state.particles;
  WallContactTable& c = e.state.wall_contacts;
  const auto row =
      static_cast<std::size_t>(std::find(c.touching.begin(), c.touching.end(), 1) - c.touching.begin());
  Vec3Array& stored = rolls ? c.rolling_moment : c.history;
  const Vec3 stress =
      (rolls ? half_limit_moment(s, {0, 0, c.force.get(row).z}) : half_limit(s)) * Vec3{0.6, 0.8, 0};
  stored.set(row, stress);
  PairTable<Law::Coefficients> table(1);
  table(0, 0) = Law::prepare(s.materials[0], s.materials[0], s.interactions(0, 0), s.contact);
  const WallMix<Law> mix(table, e.state.vessel);
  ForceSums sums;
  sums.fit(p.count(), Precision::double_precision);
  std::fill(sums.double_sums.begin(), sums.double_sums.end(), 0.0);
  Vec3 before;
  for (int k = 0; k <= steps; ++k) {
    const Vec3 x = turned(place, axis, rate * k * dt);
    p.position.set(0, x);
    const Seen seen = p.seen.get(0);
    p.seen.set(0, {x, seen.radius, rate * cross(axis, x), seen.mass, rate * axis, seen.material});
    evaluate_walls<Law, friction>(mix, e.state, sums, k == 0 ? 0 : dt, 0);
    if (k == 0) before = c.force.get(row);
  }
  const double of_stress = norm(stored.get(row) - turned(stress, axis, 0.5 * pi)) / norm(stress);
  CHECK(norm(c.force.get(row) - turned(before, axis, 0.5 * pi)) < 2 * (of_stress + 1e-9) * norm(before));
  return of_stress;
}

}  // namespace

TEST_CASE("transport alone keeps the displacement's length, in the plane of the contact", "[transport]") {
  RandomStream random(5, 0);
  const auto small = [&] { return random.uniform(-0.02, 0.02); };
  Vec3 n = unit({1, 2, 3}), u = 1e-6 * unit(cross(n, {0, 0, 1}));
  for (int k = 0; k < 10000; ++k) {
    const Vec3 now = unit(n + Vec3{small(), small(), small()});
    u = spin_about_normal(follow_normal(u, n, now), now, small());
    n = now;
  }
  CHECK(norm(u) == Approx(1e-6).epsilon(1e-12));
  CHECK(std::fabs(dot(u, n)) < 1e-12 * norm(u));
}

TEST_CASE("transport around an eighth of the sphere turns the displacement by its area", "[transport]") {
  // Parallel transport (Gauss-Bonnet): a normal that goes x -> y -> z -> x comes back with a displacement that is
  // turned about x by the solid angle pi/2, from z to -y.
  const Vec3 corners[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
  Vec3 n = corners[0], u{0, 0, 1};
  for (int side = 0; side < 3; ++side) {
    const Vec3 axis = cross(corners[side], corners[side + 1]);
    for (int k = 1; k <= 7; ++k) {
      const Vec3 now = turned(corners[side], axis, 0.5 * pi * k / 7);
      u = follow_normal(u, n, now);
      n = now;
    }
  }
  CHECK(norm(u - Vec3{0, -1, 0}) < 1e-14);
  CHECK(norm(spin_about_normal(Vec3{0, 1, 0}, Vec3{1, 0, 0}, 1e-3) - turned({0, 1, 0}, {1, 0, 0}, 2e-3)) < 1e-9);
}

namespace {

template <Friction friction>
void pair_takes_stress_along() {
  const Vec3 n = unit({2, 3, 6});
  // About an axis perpendicular to the normal: of third order, for the normal of before is found from the velocity.
  const Vec3 across = unit(cross(n, {0, 1, 0}));
  CHECK(drift_of_pair<friction>(across, 100) / drift_of_pair<friction>(across, 200) == Approx(8).epsilon(0.02));
  CHECK(drift_of_pair<friction>(across, 2000) < 1e-9);
  for (const Vec3 axis : {n, -n, unit({1, 2, -1})}) {  // about it: the mean spin turns the displacement
    const double coarse = drift_of_pair<friction>(axis, 100), fine = drift_of_pair<friction>(axis, 200);
    CHECK(coarse > 1e-7);
    CHECK(coarse / fine == Approx(4).epsilon(0.02));
    CHECK(drift_of_pair<friction>(axis, 10000) < 1e-5);
  }
}

template <Friction friction>
void grain_on_plate_takes_stress_along() {
  const double coarse = drift_on_plate<friction>(100), fine = drift_on_plate<friction>(200);
  CHECK(coarse / fine == Approx(4).epsilon(0.02));
  CHECK(drift_on_plate<friction>(10000) < 1e-5);
}

}  // namespace

TEST_CASE("a stressed pair turned by 90 degrees as a rigid body takes its displacement and force along",
          "[transport]") {
  pair_takes_stress_along<Friction::sliding>();
}

TEST_CASE("a stressed grain that spins with its plate takes its displacement and force along", "[transport]") {
  grain_on_plate_takes_stress_along<Friction::sliding>();
}

TEST_CASE("a loaded rolling spring turned as a rigid body, of a pair or on a plate, takes its moment along",
          "[transport]") {
  pair_takes_stress_along<Friction::spring>();
  grain_on_plate_takes_stress_along<Friction::spring>();
}
