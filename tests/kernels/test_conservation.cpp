// test_conservation.cpp: what turning a scene, renaming its grains, a seam, a departure elsewhere must not change,
// and what collisions must keep.
#include <algorithm>

#include "core/random.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

Vec3 turned(Vec3 v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y, v.z};
}

/// Grains of many sizes and two materials in a cylinder, not overlapping, falling and spinning.
std::vector<Grain> shower(int count, double radius, double height, std::uint64_t seed) {
  RandomStream random(seed, 0);
  std::vector<Grain> grains;
  for (int tries = 0; static_cast<int>(grains.size()) < count; ++tries) {
    REQUIRE(tries < 1000000);
    const double r = std::sqrt(random.uniform()) * (radius - 0.7 * d), phi = random.uniform(0, 2 * pi);
    Grain g{
        R * random.uniform(0.8, 1.2), {r * std::cos(phi), r * std::sin(phi), random.uniform(d, height)}, {}, {}};
    g.material = static_cast<int>(grains.size()) % 2;
    if (std::any_of(grains.begin(), grains.end(),
                    [&](const Grain& h) { return norm(h.x - g.x) < g.radius + h.radius; }))
      continue;
    g.v = {random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-1.5, 0.0)};
    g.w = {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20)};
    grains.push_back(g);
  }
  return grains;
}

Scene two_materials() {
  Scene s;
  s.materials = {{"a", 3800, 1e7, 0.3}, {"b", 2500, 2e7, 0.2}};
  s.interactions = PairTable<Interaction>(2);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b <= a; ++b) s.interactions(a, b) = {0.4 + 0.1 * (a + b), 1e-4, 0.2, 0.3, {}, true};
  s.domain.gravity = Eigen::Vector3d::Zero();
  return s;
}

Scene pot() {
  Scene s = two_materials();
  add_wall(s, "pot", {{0, 0}, {5 * d, 0}, {5 * d, 9 * d}});
  s.domain.gravity = {0, 0, -9.81};
  return s;
}

struct Motion {
  Vec3 momentum, angular_momentum;
};
Motion motion_of(const State& state) {
  const Particles& p = state.particles;
  Motion m;
  for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
    m.momentum += p.mass[i] * p.velocity.get(i);
    m.angular_momentum += p.mass[i] * cross(p.position.get(i), p.velocity.get(i)) +
                          sphere_inertia(p.mass[i], p.radius[i]) * p.angular_velocity.get(i);
  }
  return m;
}

}  // namespace

TEST_CASE("a scene turned about its axis by any angle runs the same, turned", "[symmetry]") {
  const auto grains = shower(250, 5 * d, 8 * d, 3);
  const Scene s = pot();
  for (const double angle : {0.3, 1.0, 2.5, pi}) {
    std::vector<Grain> there = grains;
    for (Grain& g : there) g.x = turned(g.x, angle), g.v = turned(g.v, angle), g.w = turned(g.w, angle);
    Experiment a(s, grains, 1e-5), b(s, there, 1e-5);
    a.run(1500);
    b.run(1500);
    CHECK(a.touching() > 40);
    CHECK(a.touching() == b.touching());
    double worst = 0;
    for (int i = 0; i < 250; ++i) worst = std::max(worst, norm(turned(a.x(i), angle) - b.x(i)));
    CHECK(worst < 1e-9 * d);
  }
}

TEST_CASE("other ids, other roles in each contact: the same run", "[symmetry]") {
  const auto grains = shower(250, 5 * d, 8 * d, 4);
  const Scene s = pot();
  std::vector<Grain> reversed(grains.rbegin(), grains.rend());
  Experiment a(s, grains, 1e-5), b(s, reversed, 1e-5);
  a.run(1500);
  b.run(1500);
  CHECK(a.touching() > 40);
  double worst = 0;
  for (int i = 0; i < 250; ++i) worst = std::max(worst, norm(a.x(i) - b.x(249 - i)));
  CHECK(worst < 1e-9 * d);
}

TEST_CASE("a pair in contact carried through both seams, either way, as in free space", "[symmetry][sector]") {
  const int n = 8;
  const Symmetry symmetry = Symmetry::rotation(n);
  for (const double sense : {1.0, -1.0}) {
    for (const bool swap : {false, true}) {
      Scene free = two_materials(), sector = free;
      make_sector(sector, n, AxisRule::clamp);
      const double r = 3 * d, start = sense > 0 ? symmetry.angle() - 0.06 : 0.06;
      const Vec3 x = turned({r, 0, 0.1}, start), drift = turned({0, sense * 30, 0}, start);
      const Vec3 along = turned({0.28, 0.0, 0.96}, start);
      std::vector<Grain> pair{
          {R, x, drift + 0.04 * along, {5, 6, 70}, 0},
          {1.2 * R, x + 2.1995 * R * along, drift - 0.04 * along + Vec3{0, 0, 0.03}, {-8, 30, 2}, 1}};
      if (swap) std::swap(pair[0], pair[1]);
      Experiment a(free, pair, 5e-7), b(sector, pair, 5e-7);
      int seams = 0;
      while (b.touching() > 0) {
        a.run(1);
        b.run(1);
        int most = 0;
        for (const auto t : b.state.particles.turns) most = std::max(most, std::abs(t));
        if (b.touching() > 0) seams = std::max(seams, most);
      }
      CHECK(seams >= 2);  // in contact all the way
      for (int i = 0; i < 2; ++i) {
        const std::size_t s = b.slot(i);
        const int k = b.state.particles.turns[s];
        CHECK(norm(symmetry.turn_point(b.state.particles.position.get(s), k) - a.x(i)) < 1e-11 * d);
        CHECK(norm(symmetry.turn_vector(b.state.particles.velocity.get(s), k) - a.v(i)) < 1e-9);
        CHECK(norm(symmetry.turn_vector(b.state.particles.angular_velocity.get(s), k) - a.w(i)) < 1e-7);
      }
    }
  }
}

TEST_CASE("a grain that leaves elsewhere changes nothing for a pair in contact, to the bit", "[symmetry]") {
  Scene s = two_materials();
  s.domain.outlet_height = -0.05;
  const std::vector<Grain> pair{{R, {0, 0, 0.1}, {0.05, 0, 0.02}, {5, 6, 70}, 0},
                                {1.2 * R, {2.199 * R, 0.1 * R, 0.1}, {-0.05, 0, 0}, {-8, 30, 2}, 1}};
  std::vector<Grain> with_third = pair;
  with_third.insert(with_third.begin(), {R, {0.1, 0, -0.0495}, {0, 0, -1}, {}, 0});
  Experiment alone(s, pair, 1e-6), watched(s, with_third, 1e-6);
  int at_departure = 0;
  for (int k = 0; k < 1500; ++k) {
    const auto before = watched.state.particles.count();
    alone.run(1);
    watched.run(1);
    if (watched.state.particles.count() < before) at_departure = watched.touching();
  }
  CHECK(watched.state.taken_out == 1);
  CHECK(at_departure == 1);
  for (int i = 0; i < 2; ++i) {
    CHECK(norm(watched.x(i + 1) - alone.x(i)) == 0);
    CHECK(norm(watched.v(i + 1) - alone.v(i)) == 0);
    CHECK(norm(watched.w(i + 1) - alone.w(i)) == 0);
  }
}

TEST_CASE("collisions in free space keep momentum and angular momentum", "[conservation]") {
  Scene s = two_materials();
  s.contact.rolling = RollingModel::none;
  Experiment e(s, shower(250, 6 * d, 6 * d, 5), 1e-5);
  const Motion before = motion_of(e.state);
  int most = 0;
  for (int k = 0; k < 20; ++k) e.run(50), most = std::max(most, e.touching());
  CHECK(most > 20);
  const Motion after = motion_of(e.state);
  CHECK(norm(after.momentum - before.momentum) < 1e-13 * norm(before.momentum));
  CHECK(norm(after.angular_momentum - before.angular_momentum) < 1e-11 * norm(before.angular_momentum));
}

TEST_CASE("collisions in a sector keep what lies along the axis", "[conservation][sector]") {
  for (const int n : {2, 3, 4, 12}) {
    Scene s = two_materials();
    s.contact.rolling = RollingModel::none;
    make_sector(s, n, AxisRule::images);
    const Symmetry symmetry = Symmetry::rotation(n);
    std::vector<Grain> grains;
    for (const Grain& g : shower(900, 14 * d, 4 * d, 6)) {  // those of the sector that are clear of copies
      if (symmetry.turns_home(g.x) != 0 || std::hypot(g.x.x, g.x.y) < 1.3 * R / std::sin(pi / n)) continue;
      bool clear = true;
      for (int k = 1; k < n; ++k)
        for (const Grain& h : grains)
          clear = clear && norm(symmetry.turn_point(h.x, k) - g.x) > g.radius + h.radius;
      if (clear) grains.push_back(g);
    }
    Experiment e(s, grains, 1e-5);
    const Motion before = motion_of(e.state);
    int seam_contacts = 0;
    for (int k = 0; k < 20; ++k) {
      e.run(50);
      for (Index row = 0; row < e.state.contacts.rows(); ++row)
        seam_contacts += row_overlap(e.state, static_cast<std::size_t>(row)) > 0 &&
                         row_partner(e.state, static_cast<std::size_t>(row)).turn != 0;
    }
    CHECK(seam_contacts > 0);
    const Motion after = motion_of(e.state);
    const double scale = norm(before.momentum), lever = 14 * d * scale;
    CHECK(std::fabs(after.momentum.z - before.momentum.z) < 1e-13 * scale);
    CHECK(std::fabs(after.angular_momentum.z - before.angular_momentum.z) < 1e-11 * lever);
  }
}
