// test_sector.cpp: the periodic faces: known answers on rings, unfolding, seams.
#include "core/random.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/known_answer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

double radius_of(Vec3 p) { return std::hypot(p.x, p.y); }

Vec3 turned(Vec3 v, double angle) {
  return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y, v.z};
}

/// The n copies of every grain: copy m of grain i has id m * count + i.
std::vector<Grain> unfolded(const std::vector<Grain>& grains, int n) {
  const Symmetry symmetry = Symmetry::rotation(n);
  std::vector<Grain> all;
  for (int m = 0; m < n; ++m)
    for (const Grain& g : grains)
      all.push_back({g.radius, symmetry.turn_point(g.x, m), symmetry.turn_vector(g.v, m),
                     symmetry.turn_vector(g.w, m), g.material});
  return all;
}

/// Grains at random in a sector (several sizes and materials), no two overlapping, own copies included, r > r_min.
std::vector<Grain> random_grains(int n, double r_min, double r_max, double height, int count, std::uint64_t seed) {
  RandomStream random(seed, 0);
  const Symmetry symmetry = Symmetry::rotation(n);
  std::vector<Grain> grains;
  for (int tries = 0; static_cast<int>(grains.size()) < count && tries < 400000; ++tries) {
    const double r = std::sqrt(random.uniform(r_min * r_min, r_max * r_max)),
                 phi = random.uniform(0, symmetry.angle());
    Grain g{R * random.uniform(0.8, 1.2),
            {r * std::cos(phi), r * std::sin(phi), random.uniform(2 * R, height)},
            {},
            {},
            tries % 2};
    bool free = true;
    for (int k = 0; k < n && free; ++k) {
      const Vec3 copy = symmetry.turn_point(g.x, k);
      for (const Grain& h : grains) free = free && norm(copy - h.x) > g.radius + h.radius;
      if (k > 0) free = free && norm(copy - g.x) > 2 * g.radius;
    }
    if (!free) continue;
    g.v = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-1.5, 0.0)};
    g.w = {random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20)};
    grains.push_back(g);
  }
  REQUIRE(static_cast<int>(grains.size()) == count);
  return grains;
}

/// A pot with two materials, friction and rolling friction on.
Scene pot(double r, double height) {
  Scene s;
  s.materials = {{"a", 3800, 1e7, 0.3}, {"b", 2500, 2e7, 0.2}};
  s.interactions = PairTable<Interaction>(2);
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b <= a; ++b) {
      Interaction& c = s.interactions(a, b);
      c.sliding = 0.4 + 0.1 * (a + b);
      c.rolling = 1e-4;
      c.damping_normal = 0.2;
      c.damping_tangential = 0.3;
    }
  add_wall(s, "pot", {{0, 0}, {r, 0}, {r, height}});
  s.domain.gravity = {0, 0, -9.81};
  return s;
}

}  // namespace

TEST_CASE("ring breathing: a grain meets its own copies", "[sector][images]") {
  struct Row {
    int n;
    double turning_radius, overlap;
  };
  const char* source = "energy and Hertz, solved separately";
  KnownAnswer radius("09a", "ring breathing, n 12, 6, 4, 2: turning radius", source, Measure::absolute, "d");
  KnownAnswer overlap("09b", "ring breathing, n 12, 6, 4, 2: largest overlap", source, Measure::relative, "d");
  for (const Row& row :
       {Row{12, 1.9153, 8.565e-3}, Row{6, 0.9914, 8.565e-3}, Row{4, 0.7011, 8.565e-3}, Row{2, 0.4943, 1.130e-2}}) {
    Scene s = plain_scene(1e7, 0.3, 3800);
    make_sector(s, row.n, AxisRule::images);
    const double r = R / std::sin(pi / row.n) + 0.02 * d, phi = 0.3 * 2 * pi / row.n;
    Experiment e(s, {{R, turned({r, 0, 0.1}, phi), turned({-0.1, 0, 0}, phi), {}}}, 1e-6);
    double least = r, deepest = 0;
    e.run_until(
        [&] {
          least = std::min(least, radius_of(e.x(0)));
          deepest = std::max(deepest, e.deepest_overlap());
          return radius_of(e.x(0)) > r;
        },
        100000);
    radius.add(least / d, row.turning_radius);
    overlap.add(deepest / d, row.overlap);
    CHECK(norm(e.v(0)) == Approx(0.1).epsilon(1e-4));  // energy came back
    CHECK(std::fabs(e.residual()) < 1e-4 * e.begin.kinetic);
  }
  CHECK(radius.within(1e-4));
  CHECK(overlap.within(1e-3));
}

TEST_CASE("a spinning ring keeps its angular momentum with friction on", "[sector][images]") {
  KnownAnswer answer("09c", "spinning ring with friction, n 2, 3, 4, 12: angular momentum", "conservation",
                     Measure::relative, "kg m2/s");
  for (const int n : {2, 3, 4, 12}) {
    Scene s = plain_scene(1e7, 0.3, 3800, 0.6, 0.3);
    make_sector(s, n, AxisRule::images);
    const double r = R / std::sin(pi / n) * (1 - 2e-3), phi = 0.4 * 2 * pi / n;
    Experiment e(s, {{R, turned({r, 0, 0.1}, phi), turned({-0.02, 0.05, 0}, phi), {0, 0, 30}}}, 2e-6);
    const auto angular = [&] {
      const Vec3 x = e.x(0), v = e.v(0);
      return e.mass(0) * (x.x * v.y - x.y * v.x) + sphere_inertia(e.mass(0), R) * e.w(0).z;
    };
    const double before = angular(), spin = e.w(0).z;
    e.run(3000);
    answer.add(angular(), before);
    if (n > 2)
      CHECK(std::fabs(e.w(0).z - spin) >
            0.01 * spin);  // friction did act; the two of a pair roll on each other alike
  }
  CHECK(answer.within(1e-12));
}

namespace {

constexpr double pot_radius = 6 * d;

/// Contacts of the whole vessel that the contacts of a sector stand for: n each, but for a grain with its own copy
/// half a turn away, of which there are n / 2.
int contacts_in_the_whole(const State& slice, int n) {
  const ContactTable& c = slice.contacts;
  int twice = 0;
  for (Index k = 0; k < c.rows(); ++k) {
    const auto r = static_cast<std::size_t>(k);
    if (!(row_overlap(slice, r) > 0)) continue;
    twice += row_is_shared(slice, r) ? n : 2 * n;
  }
  return twice / 2;
}

/// Runs a sector and the full vessel with the sector's copies side by side.
/// The largest difference of a position after 100 steps goes to `answer`, in diameters; after 2000 it may be
/// `late`.
void compare_with_whole(KnownAnswer& answer, const Scene& full, int n, AxisRule axis, double r_min, double height,
                        double late = 1e-5) {
  const auto grains = random_grains(n, r_min, pot_radius - 0.7 * d, height, 300 / n, 11);
  Scene sector = full;
  make_sector(sector, n, axis);
  Experiment whole(full, unfolded(grains, n), 1e-5), slice(sector, grains, 1e-5);
  const Symmetry symmetry = Symmetry::rotation(n);
  const int count = static_cast<int>(grains.size());
  const auto largest_difference = [&] {
    double worst = 0;
    for (int i = 0; i < count; ++i) {
      const std::size_t s = slice.slot(i);
      const Vec3 unrolled =
          symmetry.turn_point(slice.state.particles.position.get(s), slice.state.particles.turns[s]);
      for (int m = 0; m < n; ++m)
        worst = std::max(worst, norm(whole.x(m * count + i) - symmetry.turn_point(unrolled, m)));
    }
    return worst / d;
  };
  int most_contacts = 0, crossings = 0;
  for (int block = 0; block < 20; ++block) {
    whole.run(100);
    slice.run(100);
    if (block == 0) answer.add(largest_difference(), 0);
    CHECK(whole.touching() == contacts_in_the_whole(slice.state, n));
    most_contacts = std::max(most_contacts, slice.touching());
  }
  CHECK(largest_difference() < late);
  for (const auto t : slice.state.particles.turns) crossings += t != 0;
  CHECK(most_contacts > count / 4);  // it was not a comparison of free flights
  CHECK(crossings > 0);
}

/// Grains so far out do not meet their own copies at the start.
double clear_of_own_copies(int n) { return R / std::sin(pi / n) * 1.25; }

}  // namespace

TEST_CASE("unfold and compare: a sector and the full vessel with symmetric data are the same", "[sector][images]") {
  KnownAnswer answer("09d", "sector against full vessel, n 2, 4, 6, 8, 10, 12, 18, 100 steps: every position",
                     "the full vessel", Measure::absolute, "d");
  for (const int n : {2, 4, 6, 8, 10, 12, 18}) {
    CAPTURE(n);
    compare_with_whole(answer, pot(pot_radius, 8 * d), n, AxisRule::images, clear_of_own_copies(n),
                       (n > 12 ? 6.0 : 4.5) * d);
  }
  CHECK(answer.within(1e-12));
}

TEST_CASE("unfold and compare with the options of the contact", "[sector][images]") {
  Scene relative = pot(pot_radius, 8 * d), spring = relative, total = relative;
  relative.contact.rolling_velocity = RollingVelocity::relative;
  spring.contact.rolling = RollingModel::elastic_plastic_spring;
  total.contact.coulomb = Coulomb::total;
  total.contact.tension = Tension::none;
  KnownAnswer answer(
      "09f",
      "sector against full vessel, rolling `relative`, `elastic_plastic_spring`, and `coulomb = \"total\"`, n 4",
      "the full vessel", Measure::absolute, "d");
  for (const Scene& scene : {relative, spring, total})
    compare_with_whole(answer, scene, 4, AxisRule::images, clear_of_own_copies(4), 4.5 * d);
  CHECK(answer.within(1e-12));
}

TEST_CASE("unfold and compare in mixed precision", "[sector][images][precision]") {
  KnownAnswer answer("09h", "sector against full vessel in mixed precision, n 4, 12", "the full vessel",
                     Measure::absolute, "d");
  Scene full = pot(pot_radius, 8 * d);
  full.run.precision = Precision::mixed;
  for (const int n : {4, 12})
    compare_with_whole(answer, full, n, AxisRule::images, clear_of_own_copies(n), 4.5 * d, 1e-2);
  CHECK(answer.within(1e-6));
}

TEST_CASE("unfold and compare around an inner cylinder", "[sector][hollow]") {
  KnownAnswer answer("09g", "sector against full vessel around an inner cylinder (axis `hollow`), n 2, 6, 12",
                     "the full vessel", Measure::absolute, "d");
  for (const int n : {2, 6, 12}) {
    CAPTURE(n);
    Scene full = pot(pot_radius, 8 * d);
    full.domain.axis = AxisRule::hollow;
    full.domain.inner_radius = 2 * d;
    const double r_min = std::max(full.domain.inner_radius + 0.61 * d, clear_of_own_copies(n));
    compare_with_whole(answer, full, n, AxisRule::hollow, r_min, 6 * d);
  }
  CHECK(answer.within(1e-12));
}

TEST_CASE("a frictional pair carried across a seam behaves as in free space", "[sector]") {
  KnownAnswer answer("09e", "frictional pair carried across a seam, n 2 ... 12: every position", "free space",
                     Measure::absolute, "m");
  for (const int n : {2, 3, 4, 6, 12}) {
    for (const bool swap : {false, true}) {
      Scene free = plain_scene(1e7, 0.3, 3800, 0.6, 0.1), sector = free;
      make_sector(sector, n, AxisRule::images);
      const double face = 2 * pi / n, r = 20 * d;
      // Two touching grains of unequal size around the face phi = angle, sheared, carried across and back round.
      const Vec3 centre = turned({r, 0, 0.1}, face - 0.02);
      const Vec3 along = turned({0.6, 0.8, 0.1}, face), drift = turned({0, 1.5, 0}, face);
      const double gap = 0.995 * (R + 1.3 * R) / norm(along);
      std::vector<Grain> pair{{R, centre, drift + Vec3{0, 0, 0.05}, {5, 6, 70}},
                              {1.3 * R, centre + gap * along, drift, {-8, 30, 2}}};
      if (swap) std::swap(pair[0], pair[1]);
      Experiment a(free, pair, 1e-6), b(sector, pair, 1e-6);
      const Symmetry symmetry = Symmetry::rotation(n);
      a.run(2000);
      b.run(2000);
      for (int i = 0; i < 2; ++i) {
        const std::size_t s = b.slot(i);
        const int k = b.state.particles.turns[s];
        answer.add(norm(symmetry.turn_point(b.state.particles.position.get(s), k) - a.x(i)), 0);
        CHECK(norm(symmetry.turn_vector(b.state.particles.velocity.get(s), k) - a.v(i)) < 1e-10);
        CHECK(norm(symmetry.turn_vector(b.state.particles.angular_velocity.get(s), k) - a.w(i)) < 1e-8);
      }
      CHECK(norm(a.v(0) - pair[0].v) > 1e-3);
    }
  }
  CHECK(answer.within(2e-13 * 20 * d));
}
