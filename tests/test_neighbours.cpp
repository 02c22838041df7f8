// test_neighbours.cpp: neighbour lists, images and sums of forces against brute force.
#include <map>
#include <set>
#include <tuple>

#include "core/random.hpp"
#include "tests/catch.hpp"
#include "tests/laboratory.hpp"

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
