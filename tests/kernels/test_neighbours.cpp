// test_neighbours.cpp: neighbour lists, images and sums of forces against brute force.
#include <map>
#include <set>
#include <tuple>

#include "core/random.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

struct Case {
  DomainKind kind;
  int order;
  AxisRule axis;
};

Scene scene_of(const Case& c) {
  Scene s = plain_scene(1e7, 0.3, 3800, 0.5, 0.3);
  s.domain.kind = c.kind;
  s.domain.order = c.order;
  s.domain.axis = c.axis;
  s.domain.slot_width = 0.03;
  return s;
}

/// Grains of several sizes in the domain; overlaps do not matter here but stay small.
std::vector<Grain> cloud(const Scene& scene, int count, std::uint64_t seed, double height = 0.02) {
  RandomStream random(seed, 0);
  const Symmetry symmetry = scene.domain.kind == DomainKind::sector ? Symmetry::rotation(scene.domain.order)
                            : scene.domain.kind == DomainKind::slot ? Symmetry::translation(scene.domain.slot_width)
                                                                    : Symmetry::none();
  std::vector<Grain> grains;
  while (static_cast<int>(grains.size()) < count) {
    Vec3 x{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(0, height)};
    x = symmetry.turn_point(x, symmetry.turns_home(x));
    Grain g{
        0.001 * random.uniform(1, 2), x, {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, {}};
    bool deep = false;
    for (int k = -scene.domain.order; k <= scene.domain.order && !deep; ++k) {
      const Vec3 copy = symmetry.turn_point(x, k);
      for (const Grain& h : grains) deep = deep || norm(copy - h.x) < 0.9 * (g.radius + h.radius);
      if (symmetry.periodic() && symmetry.residue(k) != 0) deep = deep || norm(copy - x) < 1.8 * g.radius;
    }
    if (!deep) grains.push_back(g);
  }
  return grains;
}

using Identity = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // smaller id, larger id, turn

}  // namespace

TEST_CASE("the neighbour list holds exactly the pairs of a search over all pairs and turns", "[neighbours]") {
  for (const Case& c :
       {Case{DomainKind::full, 1, AxisRule::clamp}, Case{DomainKind::slot, 1, AxisRule::clamp},
        Case{DomainKind::sector, 2, AxisRule::clamp}, Case{DomainKind::sector, 2, AxisRule::images},
        Case{DomainKind::sector, 3, AxisRule::clamp}, Case{DomainKind::sector, 4, AxisRule::clamp},
        Case{DomainKind::sector, 4, AxisRule::images}, Case{DomainKind::sector, 12, AxisRule::clamp},
        Case{DomainKind::sector, 12, AxisRule::images}}) {
    const Scene scene = scene_of(c);
    Experiment e(scene, cloud(scene, 500 / c.order, 3), 1e-6);
    const State& s = e.state;
    const Particles& p = s.particles;
    const auto n = static_cast<std::size_t>(p.count());

    std::set<Identity> expected;
    const int last = c.kind == DomainKind::full ? 0 : c.kind == DomainKind::slot ? 1 : c.order;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        for (int k = -last; k <= last; ++k) {
          const int turn = s.symmetry.residue(k);
          const bool acts =
              turn == 0 || c.kind == DomainKind::slot || c.axis == AxisRule::images || turn == 1 || turn == -1;
          const bool own = i == j && (turn == 0 || turn < 0 || c.axis != AxisRule::images);
          if (!acts || own || p.id[i] > p.id[j]) continue;
          const double reach = p.radius[i] + p.radius[j] + p.list_margin[i] + p.list_margin[j];
          if (norm(s.symmetry.turn_point(p.position.get(j), turn) - p.position.get(i)) < reach)
            expected.insert({p.id[i], p.id[j], turn});
        }
    std::set<Identity> found;
    for (Index k = 0; k < s.contacts.rows(); ++k) {
      const auto r = static_cast<std::size_t>(k);
      const auto first = static_cast<std::size_t>(s.contacts.first[r]),
                 second = static_cast<std::size_t>(s.contacts.second[r]);
      const auto [partner, turn] = row_partner(s, r);
      const auto owner = static_cast<std::size_t>(partner);
      CHECK(found.insert({p.id[first], p.id[owner], turn}).second);  // once each
      const Vec3 where = s.symmetry.turn_point(p.position.get(owner), turn);
      CHECK(norm(where - p.position.get(second)) < 1e-15);
    }
    CHECK(found == expected);
    CHECK(expected.size() > n / 4);
  }
}

TEST_CASE("partners that only just reach across a face are in the list, however thin the list", "[neighbours]") {
  const double wide = 0.003, narrow = 0.001, skin = 2e-4, far = 0.04;
  for (const Case& c :
       {Case{DomainKind::slot, 1, AxisRule::clamp}, Case{DomainKind::sector, 2, AxisRule::clamp},
        Case{DomainKind::sector, 3, AxisRule::clamp}, Case{DomainKind::sector, 4, AxisRule::images},
        Case{DomainKind::sector, 12, AxisRule::clamp}, Case{DomainKind::sector, 12, AxisRule::images}}) {
    Scene scene = scene_of(c);
    scene.run.skin = skin;  // of grains at rest: the sum of the margins of two
    const Symmetry symmetry =
        c.kind == DomainKind::slot ? Symmetry::translation(scene.domain.slot_width) : Symmetry::rotation(c.order);
    const auto rows = [&](double reach) {  // with partners this far apart, in what the list reaches
      std::vector<Grain> grains;
      double z = 0;
      const auto add = [&](double radius, Vec3 x) { grains.push_back({radius, {x.x, x.y, z}, {}, {}}); };
      for (const auto& [on_face, inside] : {std::pair{wide, narrow}, std::pair{narrow, wide}}) {
        const double apart = reach * (wide + narrow + skin);
        const Vec3 just_within{far, 1e-12, 0}, just_without{far, -1e-12, 0};
        const Vec3 below = symmetry.turn_point({far, -apart, 0}, 1);  // `apart` from the second face
        for (const bool first : {false, true}) {                      // the smaller id looks for its partners
          if (first) add(inside, below);
          add(on_face, just_within);
          if (!first) add(inside, below);
          z += 0.02;
          if (first) add(inside, {far, apart, 0});
          add(on_face, symmetry.turn_point(just_without, 1));
          if (!first) add(inside, {far, apart, 0});
          z += 0.02;
        }
      }
      return Experiment(scene, grains, 1e-6).state.contacts.rows();
    };
    CHECK(rows(1 - 1e-6) == 8);
    CHECK(rows(1 + 1e-6) == 0);
  }
}

TEST_CASE("every copy of a grain within reach of the domain is an image, and no other", "[neighbours]") {
  for (const int order : {2, 3, 4, 6, 12}) {
    const Scene scene = scene_of({DomainKind::sector, order, AxisRule::images});
    Experiment e(scene, cloud(scene, 500 / order, 5), 1e-6);
    const Particles& p = e.state.particles;
    std::set<std::pair<Index, int>> images;
    for (Index m = 0; m < e.state.images.count(); ++m)
      images.insert(
          {e.state.images.owner[static_cast<std::size_t>(m)], e.state.images.turn[static_cast<std::size_t>(m)]});
    CHECK(static_cast<Index>(images.size()) == e.state.images.count());
    double widest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i)
      widest = std::max(widest, p.radius[i] + p.list_margin[i]);
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i) {
      for (int k = 1; k < order; ++k) {
        const int turn = e.state.symmetry.residue(k);
        const double distance = e.state.symmetry.distance_to_domain(p.position.get(i), turn);
        const bool near = distance <= widest + p.radius[i] + p.list_margin[i];
        CHECK(images.count({static_cast<Index>(i), turn}) == (near ? 1u : 0u));
      }
    }
  }
}

TEST_CASE("what a grain feels is the sum over all pairs, summed by brute force", "[neighbours]") {
  // Momentum: full vessel and slot keep P; a sector's forces on grains equal those of direct evaluation of every
  // row.
  for (const Case& c :
       {Case{DomainKind::full, 1, AxisRule::clamp}, Case{DomainKind::slot, 1, AxisRule::clamp},
        Case{DomainKind::sector, 4, AxisRule::images}, Case{DomainKind::sector, 3, AxisRule::clamp}}) {
    const Scene scene = scene_of(c);
    // Enough for several tiles, whose grains act on each other's and on images of each other's.
    Experiment e(scene, cloud(scene, 3 * tile_size, 7, 0.15 * c.order), 1e-6);
    e.run(20);
    const State& s = e.state;
    const auto n = static_cast<std::size_t>(s.particles.count());
    std::vector<Vec3> force(n), torque(n);
    for (std::size_t r = 0; r < static_cast<std::size_t>(s.contacts.rows()); ++r) {
      const auto [partner, turn] = row_partner(s, r);
      const auto i = static_cast<std::size_t>(s.contacts.first[r]), j = static_cast<std::size_t>(partner);
      const Vec3 f = e.contact_force(r), q = cross(row_normal(s, r), f);
      const double half = 0.5 * std::max(0.0, row_overlap(s, r));
      force[i] += f;
      torque[i] += (s.particles.radius[i] - half) * q;
      if (i == j && 2 * turn == c.order) continue;
      force[j] -= s.symmetry.turn_vector(f, -turn);
      torque[j] += (s.particles.radius[j] - half) * s.symmetry.turn_vector(q, -turn);
    }
    double scale = 0, worst = 0;
    for (std::size_t i = 0; i < n; ++i) {
      scale = std::max(scale, norm(force[i]));
      worst = std::max({worst, norm(force[i] - s.particles.force.get(i)),
                        norm(torque[i] - s.particles.torque.get(i)) / s.particles.radius[i]});
    }
    CHECK(scale > 0);
    CHECK(worst < 1e-8 * scale);  // contact_force is found anew, near the limit of sliding with some loss
  }
}

namespace {

/// Force on each grain of a frictionless scene by Hertz and its damping, from the places and velocities alone:
/// every grain with every copy of every other, and with its own copies where they act, each pair from both sides.
std::vector<Vec3> frictionless_forces(const Scene& scene, const Particles& p) {
  const int order = scene.domain.order;
  const auto n = static_cast<std::size_t>(p.count());
  const auto turned = [&](Vec3 a, int k) -> Vec3 {
    const long double angle = 2 * std::acos(-1.0L) * k / order;
    const auto cosine = static_cast<double>(std::cos(angle)), sine = static_cast<double>(std::sin(angle));
    return {cosine * a.x - sine * a.y, sine * a.x + cosine * a.y, a.z};
  };
  std::vector<Vec3> force(n);
  for (int k = 0; k < order; ++k) {
    const bool neighbour = k <= 1 || k == order - 1, every = meets_itself(scene.domain.axis);
    if (!neighbour && !every) continue;
    for (std::size_t j = 0; j < n; ++j) {
      const Vec3 x = turned(p.position.get(j), k), v = turned(p.seen.get(j).velocity, k);
      for (std::size_t i = 0; i < n; ++i) {
        if (i == j && (k == 0 || !every)) continue;
        const Vec3 d = x - p.position.get(i);
        const double distance = norm(d), ri = p.radius[i], rj = p.radius[j], overlap = ri + rj - distance;
        if (overlap <= 0) continue;
        const Material &a = scene.materials[static_cast<std::size_t>(p.material[i])],
                       &b = scene.materials[static_cast<std::size_t>(p.material[j])];
        const double young = 1 / ((1 - a.poisson * a.poisson) / a.young + (1 - b.poisson * b.poisson) / b.young);
        const double mi = 4.0 / 3.0 * pi * ri * ri * ri * a.density, mj = 4.0 / 3.0 * pi * rj * rj * rj * b.density;
        const double stiffness = 2 * young * std::sqrt(ri * rj / (ri + rj) * overlap);  // df/d(overlap)
        const double damping = 2 * scene.interactions(p.material[i], p.material[j]).damping_normal *
                               std::sqrt(mi * mj / (mi + mj) * stiffness);
        const Vec3 normal = (1 / distance) * d;
        const double approach = dot(p.seen.get(i).velocity - v, normal);
        force[i] -= (2.0 / 3.0 * stiffness * overlap + damping * approach) * normal;
      }
    }
  }
  return force;
}

}  // namespace

TEST_CASE("without friction a grain feels what places and velocities of its partners and their copies say",
          "[neighbours]") {
  for (const Case& c :
       {Case{DomainKind::full, 1, AxisRule::clamp}, Case{DomainKind::sector, 2, AxisRule::images},
        Case{DomainKind::sector, 5, AxisRule::images}, Case{DomainKind::sector, 3, AxisRule::clamp}}) {
    Scene scene = scene_of(c);
    scene.materials = {{"light", 1500, 1e7, 0.3}, {"heavy", 3800, 3e7, 0.2}};
    scene.interactions = PairTable<Interaction>(2);
    scene.interactions(0, 0).damping_normal = 0.1;
    scene.interactions(0, 1).damping_normal = 0.2;
    scene.interactions(1, 1).damping_normal = 0.3;
    // Three tiles, whose grains act on each other's and on images of each other's.
    std::vector<Grain> grains = cloud(scene, 2 * tile_size + 500, 11, 0.06 * c.order);
    for (std::size_t i = 0; i < grains.size(); ++i) grains[i].material = i % 3 == 0;
    Experiment e(scene, grains, 2e-6);
    const Particles& p = e.state.particles;
    for (const int steps : {0, 50}) {  // forces at the start, and after new lists
      e.run(steps);
      const std::vector<Vec3> expected = frictionless_forces(scene, p);
      double largest = 0, worst = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        largest = std::max(largest, norm(expected[i]));
        worst = std::max(worst, norm(expected[i] - p.force.get(i)));
      }
      CHECK(e.touching() > 500);
      CHECK(worst / largest < 1e-13);  // a copy's place has round-off, and so has the overlap
    }
    CHECK(e.state.list_builds > 1);
  }
}

TEST_CASE("the wall list holds exactly the features within reach of each grain", "[neighbours]") {
  Scene pot = plain_scene(1e7, 0.3, 3800);
  pot.run.skin = 4e-4;
  add_wall(pot, "funnel", {{0.02, -0.03}, {0.02, 0.0}, {0.06, 0.03}, {0.1, 0.03}, {0.1, 0.1}});
  add_wall(pot, "lid", {{0.1, 0.1}, {0.05, 0.1}});
  add_wall(pot, "spike", {{0.05, 0.09}, {0.05, 0.06}});
  add_wall(pot, "taken away", {{0.03, 0.07}, {0.04, 0.07}});
  add_wall(pot, "rising", {{0.07, 0.05}, {0.09, 0.05}});
  pot.walls[3].present = false;
  pot.walls[4].speed = 0.5;
  Scene line = pot, hollow = pot, planes = pot, slot = pot;
  make_sector(line, 6, AxisRule::line);
  make_sector(hollow, 6, AxisRule::hollow);
  hollow.domain.inner_radius = 0.01;
  make_sector(planes, 6, AxisRule::clamp);
  planes.domain.sides = Sides::rigid;
  slot.domain.kind = DomainKind::slot;
  slot.domain.slot_width = 0.05;
  slot.domain.sides = Sides::rigid;
  for (const Scene& scene : {pot, line, hollow, planes, slot}) {
    // Grains at rest, most of them with a wall at the very end of their reach, or just beyond it.
    const double dt = 1e-6, risen = 0.004, margin = 0.5 * scene.run.skin, wall_margin = 200 * dt * 0.5;
    Vessel vessel(scene);
    vessel.set_travel(4, risen);
    RandomStream random(23, 0);
    std::vector<Grain> grains;
    while (grains.size() < 600) {
      const double r = random.uniform(0.0, 0.1), phi = random.uniform(0.1, 0.9),
                   radius = random.uniform(5e-4, 2e-3);
      Vec3 x{r * std::cos(phi), r * std::sin(phi), random.uniform(-0.03, 0.1)};
      const double reach = radius + margin + wall_margin;
      const int f = static_cast<int>(random.uniform(0, vessel.feature_count()));
      const WallProximity near = vessel.proximity(f, x);
      x += (near.distance - reach * (1 + 1e-6 * random.uniform(-1, 1))) * near.normal;
      bool fits = x.y > 0 && x.y < 0.05 && std::atan2(x.y, x.x) < pi / 3;
      for (int g = 0; g < vessel.feature_count(); ++g) fits = fits && vessel.proximity(g, x).distance > radius;
      for (const Grain& h : grains) fits = fits && norm(x - h.x) > radius + h.radius;
      if (fits) grains.push_back({radius, x, {}, {}});
    }
    State s = make_state(scene, grains);
    s.vessel.set_travel(4, risen);
    TimeStep(scene, s).start(s, dt);
    CHECK(s.wall_margin == Approx(wall_margin));

    std::set<std::pair<Index, std::int32_t>> expected, found;
    int at_the_end = 0;
    for (Index i = 0; i < s.particles.count(); ++i) {
      const auto g = static_cast<std::size_t>(i);
      const double reach = s.particles.radius[g] + s.particles.list_margin[g] + s.wall_margin;
      for (int f = 0; f < vessel.feature_count(); ++f) {
        const double distance = s.vessel.proximity(f, s.particles.position.get(g)).distance;
        if (!s.vessel.active(f) || distance >= reach) continue;
        expected.insert({i, f});
        at_the_end += distance > (1 - 1e-6) * reach;
      }
    }
    const WallContactTable& w = s.wall_contacts;
    for (std::size_t g = 0; g < w.grain.size(); ++g)
      for (Index k = w.begin[g]; k < w.begin[g + 1]; ++k)
        CHECK(found.insert({w.grain[g], w.feature[static_cast<std::size_t>(k)]}).second);
    CHECK(found == expected);
    CHECK(at_the_end > 200);
  }
}

TEST_CASE("a moving bed never misses a contact: every overlap is in the list at every step", "[neighbours]") {
  const Scene scene = scene_of({DomainKind::sector, 4, AxisRule::clamp});
  Experiment e(scene, cloud(scene, 200, 9), 2e-6);
  for (int step = 0; step < 400; ++step) {
    e.run(1);
    const Particles& p = e.state.particles;
    int overlaps = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count()); ++i)
      for (std::size_t j = i + 1; j < static_cast<std::size_t>(p.count()); ++j)
        for (const int k : {-1, 0, 1})
          overlaps += norm(e.state.symmetry.turn_point(p.position.get(j), k) - p.position.get(i)) <
                      p.radius[i] + p.radius[j];
    REQUIRE(e.touching() == overlaps);
  }
  CHECK(e.state.list_builds > 2);
}
