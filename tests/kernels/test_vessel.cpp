// test_vessel.cpp: wall contacts against a search for the local minima of the distance to the revolved polyline.
#include "core/vessel.hpp"

#include "core/random.hpp"
#include "core/require.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/known_answer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// A vessel with a cone, a corner, a rim, a smooth joint between two walls and a disc with a hole.
Scene pot_of_all_sorts() {
  Scene s = plain_scene(1e7, 0.3, 3800);
  add_wall(s, "funnel", {{0.02, -0.03}, {0.02, 0.0}, {0.06, 0.03}, {0.1, 0.03}, {0.1, 0.1}});
  add_wall(s, "lid", {{0.1, 0.1}, {0.05, 0.1}});
  add_wall(s, "lid, inner part", {{0.05, 0.1}, {0.03, 0.1}});
  add_wall(s, "spike", {{0.05, 0.09}, {0.05, 0.06}});
  return s;
}

/// Local minima of the distance from q to the polylines, by walking along them in small steps: distances found.
std::vector<double> minima_by_walking(const std::vector<std::vector<Eigen::Vector2d>>& lines,
                                      const Eigen::Vector2d& q, double below) {
  std::vector<double> found;
  for (const auto& line : lines) {
    std::vector<double> d;
    for (std::size_t p = 0; p + 1 < line.size(); ++p) {
      const int steps = 20000;
      for (int m = p == 0 ? 0 : 1; m <= steps; ++m)
        d.push_back((line[p] + (line[p + 1] - line[p]) * (static_cast<double>(m) / steps) - q).norm());
    }
    for (std::size_t m = 0; m < d.size(); ++m)
      if (d[m] < below && (m == 0 || d[m - 1] > d[m]) && (m + 1 == d.size() || d[m + 1] >= d[m]))
        found.push_back(d[m]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("one contact for each local minimum of the distance to the walls", "[vessel]") {
  const Scene scene = pot_of_all_sorts();
  const Vessel vessel(scene);
  // The walls as connected lines: the lid joins the funnel and its inner part.
  const std::vector<std::vector<Eigen::Vector2d>> lines{
      {{0.02, -0.03}, {0.02, 0.0}, {0.06, 0.03}, {0.1, 0.03}, {0.1, 0.1}, {0.05, 0.1}, {0.03, 0.1}},
      {{0.05, 0.09}, {0.05, 0.06}}};
  RandomStream random(17, 0);
  int several = 0;
  for (int run = 0; run < 1500; ++run) {
    const double r = random.uniform(0.001, 0.13), z = random.uniform(-0.05, 0.12), phi = random.uniform(0, 6),
                 radius = random.uniform(0.004, 0.03);
    const Vec3 p{r * std::cos(phi), r * std::sin(phi), z};
    std::vector<double> found;
    for (int f = 0; f < vessel.feature_count(); ++f) {
      const WallProximity near = vessel.proximity(f, p);
      if (!near.minimum || near.distance >= radius) continue;
      found.push_back(near.distance);
      // the normal leads to a point of the wall, in the half plane of the grain
      CHECK(norm(near.normal) == Approx(1).epsilon(1e-12));
      CHECK(std::fabs(near.normal.x * std::sin(phi) - near.normal.y * std::cos(phi)) < 1e-12);
      CHECK(vessel.proximity(f, p + near.distance * near.normal).distance < 1e-12);
    }
    std::sort(found.begin(), found.end());
    const auto expected = minima_by_walking(lines, {r, z}, radius);
    REQUIRE(found.size() == expected.size());
    for (std::size_t m = 0; m < found.size(); ++m) CHECK(found[m] == Approx(expected[m]).margin(1e-6));
    several += found.size() > 1;
  }
  CHECK(several > 50);
}

TEST_CASE("walls that are taken away leave no contact, and their edge belongs to the neighbour", "[vessel]") {
  Scene s = plain_scene(1e7, 0.3, 3800);
  add_wall(s, "plug", {{0, 0}, {0.02, 0}});
  add_wall(s, "plate", {{0.02, 0}, {0.1, 0}});
  Vessel vessel(s);
  const auto contacts = [&](Vec3 p, double radius) {
    std::vector<int> walls;
    for (int f = 0; f < vessel.feature_count(); ++f) {
      const WallProximity near = vessel.proximity(f, p);
      if (vessel.active(f) && near.minimum && near.distance < radius) walls.push_back(vessel.carrier(f));
    }
    return walls;
  };
  CHECK(contacts({0.0199, 0, 0.002}, 0.0025) == std::vector<int>{0});
  CHECK(contacts({0.02, 0, 0.002}, 0.0025) == std::vector<int>{0});  // on the joint: once
  CHECK(contacts({0.0201, 0, 0.002}, 0.0025) == std::vector<int>{1});
  CHECK(contacts({0, 0, 0.002}, 0.0025) == std::vector<int>{0});  // on the axis: once
  vessel.set_present(0, false);
  CHECK(contacts({0.0199, 0, 0.002}, 0.0025) == std::vector<int>{1});  // the rim
  CHECK(contacts({0.015, 0, 0.002}, 0.0025).empty());
  CHECK(contacts({0, 0, 0.002}, 0.0025).empty());
}

TEST_CASE("a wall that is taken away takes along what its contacts hold", "[vessel]") {
  // Hertz: (8/15) E* sqrt(R) dn^(5/2); both materials alike, and the grain stands still.
  Scene scene = plain_scene(1e7, 0.3, 3800, 0.6, 0);
  add_wall(scene, "floor", {{0, 0}, {1, 0}});
  const double R = 0.0025, overlap = 0.02 * R, young = 1e7 / (2 * (1 - 0.3 * 0.3));
  Experiment e(scene, {{R, {0.01, 0, R - overlap}, {}, {}}}, 1e-6);
  const double stored = 8.0 / 15.0 * young * std::sqrt(R) * std::pow(overlap, 2.5);
  CHECK(e.begin.elastic_normal == Approx(stored).epsilon(1e-10));
  e.step.change_walls(e.state, {0}, {});
  CHECK(e.state.energy.carried_out == Approx(stored).epsilon(1e-10));
  CHECK(std::abs(e.residual()) < 1e-12 * stored);
}

TEST_CASE("a grain deep in a wall is refused whenever the list is made", "[vessel]") {
  const double R = 0.0025;
  Scene pot = plain_scene(1e7, 0.3, 3800);
  add_wall(pot, "shell", {{0.02, 0}, {0.02, 0.1}});
  add_wall(pot, "floor", {{0, 0}, {0.02, 0}});
  add_wall(pot, "fin", {{0.01, 0.03}, {0.01, 0.05}});
  Scene line = pot, hollow = pot;
  make_sector(line, 6, AxisRule::line);
  make_sector(hollow, 6, AxisRule::hollow);
  hollow.domain.inner_radius = 0.004;
  const auto says = [&](const Scene& scene, Vec3 x) -> std::string {
    try {
      Experiment e(scene, {{R, {0.015, 0.001, 0.095}, {}, {}}, {R, x, {}, {}}}, 1e-5);
    } catch (const PhysicsError& error) {
      return error.what();
    }
    return "";
  };
  const auto refused = [&](const Scene& scene, Vec3 x, const std::string& wall, const std::string& overlap) {
    using Catch::Matchers::Contains;
    CHECK_THAT(says(scene, x), Contains("grain 1 at (") &&
                                   Contains("overlaps the wall '" + wall + "' by " + overlap) &&
                                   Contains("in step 0") && Contains("Likely cause"));
  };
  refused(pot, {0.0185, 0, 0.08}, "shell", "0.001 m");
  refused(pot, {0.01, 0, 0.0015}, "floor", "0.001 m");
  refused(pot, {0, 0, 0}, "floor", "0.0025 m");          // on the end of its profile: no normal
  refused(pot, {0.005, 0, 0}, "floor", "0.0025 m");      // on the wall itself
  refused(pot, {0.01, 0, 0.0515}, "fin", "0.001 m");     // over its upper edge
  refused(pot, {0.01, 0, 0.05}, "fin", "0.0025 m");      // on the edge
  refused(pot, {0.0109, 0, 0.0499}, "fin", "0.0016 m");  // beside a thin wall, near its edge
  refused(line, {1e-4, 1e-4, 0.05}, "axis line", "0.00235858 m");
  refused(line, {0, 0, 0.05}, "axis line", "0.0025 m");
  refused(hollow, {0.0055, 0.0001, 0.02}, "inner cylinder", "0.000999");
  const double allowed = 0.99 * 0.3 * R;  // of an overlap
  for (const Vec3 x : {Vec3{0.02 - R + allowed, 0, 0.08}, Vec3{0.005, 0, R - allowed}, Vec3{0, 0, R - allowed},
                       Vec3{0.01, 0, 0.05 + R - allowed}, Vec3{0.01 + R - allowed, 0, 0.0499}})
    CHECK(says(pot, x) == "");
  pot.walls[2].present = false;
  CHECK(says(pot, {0.01, 0, 0.05}) == "");

  // A rising plate and a ceiling squeeze a grain; the list is made anew as the plate goes on.
  Scene press = plain_scene(1e7, 0.3, 3800, 0, 0.3);
  add_wall(press, "plate", {{0, 0}, {0.02, 0}});
  add_wall(press, "ceiling", {{0, 2.1 * R}, {0.02, 2.1 * R}});
  press.walls[0].speed = 0.1;
  Experiment e(press, {{R, {0.01, 0, 1.05 * R}, {}, {}}}, 1e-5);
  CHECK_THROWS_WITH(e.run(2000),
                    Catch::Matchers::Contains("grain 0") && Catch::Matchers::Contains("overlaps the wall"));
  const double plate = e.state.vessel.travel(0), squeezed = 2 * R - (2.1 * R - plate);
  CHECK(squeezed > 2 * 0.29 * R);
  CHECK(squeezed < 2 * 0.45 * R);
}

TEST_CASE("friction history passes from piece to piece: a joint is not felt", "[vessel]") {
  const double R = 0.0025;
  const auto slide = [&](std::vector<std::vector<Eigen::Vector2d>> pieces) {
    Scene s = plain_scene(1e7, 0.3, 3800, 0.6, 0.3);
    s.domain.gravity = {0, 0, -9.81};
    for (auto& piece : pieces) add_wall(s, "piece", piece);
    Experiment e(s, {{R, {0.0495, 0.0, R - 3e-6}, {0.05, 0.03, 0}, {0, 10, 0}}}, 5e-6);
    e.run(20000);
    return std::make_pair(e.x(0), e.w(0));
  };
  const auto one = slide({{{0, 0}, {0.2, 0}}});
  const auto bent = slide({{{0, 0}, {0.05, 0}, {0.052, 0}, {0.2, 0}}});
  const auto joined = slide({{{0, 0}, {0.05, 0}}, {{0.05, 0}, {0.052, 0}}, {{0.052, 0}, {0.2, 0}}});
  CHECK(one.first.x > 0.0535);  // it did cross both joints
  for (const auto& other : {bent, joined}) {
    CHECK(norm(other.first - one.first) < 1e-12);
    CHECK(norm(other.second - one.second) < 1e-8);
  }
}

TEST_CASE("the load on the walls is weight plus the change of momentum, at every step", "[vessel]") {
  KnownAnswer answer("09f", "load on the walls less weight and dP_z/dt, every step, in weights; full, n 4, 6",
                     "momentum", Measure::absolute);
  for (const int order : {1, 4, 6}) {
    Scene s = hopper_material();
    s.domain.gravity = {0, 0, -9.81};
    if (order > 1) make_sector(s, order, AxisRule::clamp);
    add_wall(s, "pot", {{0, 0}, {0.02, 0}, {0.03, 0.01}, {0.03, 0.2}});
    RandomStream random(2, 0);
    const Symmetry symmetry = order > 1 ? Symmetry::rotation(order) : Symmetry::none();
    std::vector<Grain> grains;
    while (static_cast<int>(grains.size()) < 240 / order) {
      const double r = random.uniform(0.004, 0.015), phi = random.uniform(0, symmetry.angle());
      Grain g{0.0025, {r * std::cos(phi), r * std::sin(phi), random.uniform(0.01, 0.15)}, {0, 0, -0.5}, {}};
      bool free = true;
      for (int k = -1; k <= 1; ++k)
        for (const Grain& h : grains) free = free && norm(symmetry.turn_point(g.x, k) - h.x) > 0.00505;
      if (free) grains.push_back(g);
    }
    Experiment e(s, grains, 2e-5);
    const auto vertical = [&] {
      double m = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(e.state.particles.count()); ++i)
        m += e.state.particles.mass[i] * e.state.particles.velocity.z[i];
      return m;
    };
    double weight = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(e.state.particles.count()); ++i)
      weight += 9.81 * e.state.particles.mass[i];
    const auto load = [&] {
      double f = 0;
      for (const double z : e.state.wall_contacts.force.z) f += z;
      return f;
    };
    double before = vertical(), load_before = load(), worst = 0, most = 0, late = 0;
    for (int k = 0; k < 15000; ++k) {
      e.run(1);
      const double now = vertical(), load_now = load();
      // both half kicks of a step: half of the old and half of the new load
      worst = std::max(worst, std::fabs(0.5 * (load_before + load_now) - weight - (now - before) / 2e-5));
      before = now;
      load_before = load_now;
      most = std::max(most, load_now);
      if (k >= 10000) late += load_now / 5000;
    }
    CHECK(most > weight);
    answer.add(worst / weight, 0);
    CHECK(late == Approx(weight).epsilon(0.03));
  }
  CHECK(answer.within(1e-9));
}

TEST_CASE("the energy budget closes", "[energy]") {
  const auto residual = [](double dt) {
    Scene s = hopper_material();
    s.domain.gravity = {0, 0, -9.81};
    make_sector(s, 4, AxisRule::clamp);
    add_wall(s, "pot", {{0, 0}, {0.02, 0}, {0.02, 0.1}});
    std::vector<Grain> grains;
    for (int layer = 0; layer < 8; ++layer)
      for (int k = 0; k < 4; ++k)
        grains.push_back({0.0025,
                          {0.004 + 0.004 * (k % 2) + 0.0003 * layer, 0.0035 + 0.0055 * (k / 2) + 0.0002 * layer,
                           0.004 + 0.0055 * layer},
                          {0.05, -0.02, -0.3},
                          {0, 30, 10}});
    Experiment e(s, grains, dt);
    e.run(static_cast<int>(0.4 / dt));  // impacts, then a bed at rest
    const EnergyLedger& l = e.state.energy;
    return std::fabs(e.residual()) / (l.normal_damping + l.tangential_damping + l.sliding + l.rolling + l.axis);
  };
  const double coarse = residual(2e-5), middle = residual(1e-5), fine = residual(5e-6);
  CAPTURE(coarse, middle, fine);
  CHECK(coarse < 1e-2);
  CHECK(middle < 0.4 * coarse);
  CHECK(fine < 0.4 * middle);
}
