// test_neighbour_list.cpp: grains put in and taken out mid-run: nobody else notices, and all counts and energies
// fit.
#include "kernels/neighbours/neighbour_list.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

#include "core/random.hpp"
#include "io/files/checkpoint.hpp"
#include "kernels/passes/measure.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double R = 0.0025, d = 2 * R, dt = 2e-5;

/// A pot of rough grains under gravity; its sectors too.
Scene pot(int order = 1) {
  Scene s = hopper_material();
  s.domain.gravity = {0, 0, -9.81};
  add_wall(s, "pot", {{0, 0}, {0.016, 0}, {0.016, 0.5}});
  if (order > 1) make_sector(s, order, AxisRule::images);
  return s;
}

/// Grains that fall into the pot, in layers that do not touch.
std::vector<Grain> falling(int order = 1) {
  RandomStream random(11, 0);
  std::vector<Grain> grains;
  const Symmetry symmetry = order > 1 ? Symmetry::rotation(order) : Symmetry::none();
  for (int layer = 0; layer < 4; ++layer) {
    for (int k = 0; k < 12; ++k) {
      const double phi = 2 * pi * (k + 0.3) / 12, r = 0.011 + 0.002 * random.uniform();
      const Vec3 x{r * std::cos(phi), r * std::sin(phi), (1.2 * layer + 0.6) * d};
      if (symmetry.turns_home(x) != 0) continue;
      const auto any = [&] { return random.uniform(-0.1, 0.1); };
      const double vx = any(), vy = any(), vz = any();
      grains.push_back({R, x, {vx, vy, vz}, {}});
    }
  }
  return grains;
}

/// The grain of an experiment with this id, to be put into another.
NewGrain taken_from(const Experiment& e, int id) {
  NewGrain g;
  g.position = e.x(id);
  g.velocity = e.v(id);
  g.angular_velocity = e.w(id);
  g.radius = e.state.particles.radius[e.slot(id)];
  g.mass = e.mass(id);
  g.material = e.state.particles.material[e.slot(id)];
  g.id = id;
  return g;
}

using Row = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // ids of both, turn
using Stored = std::array<double, 3>;
/// What each row stores that stores something, of grains and of walls.
std::map<Row, Stored> histories(const State& state) {
  std::map<Row, Stored> stored;
  const auto note = [&](Row row, Vec3 h) {
    if (h.x != 0 || h.y != 0 || h.z != 0) stored[row] = {h.x, h.y, h.z};
  };
  const auto id = [&](Index i) { return state.particles.id[static_cast<std::size_t>(i)]; };
  for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k) {
    const Partner partner = row_partner(state, k);
    note({id(state.contacts.first[k]), id(partner.grain), partner.turn}, state.contacts.history.get(k));
  }
  const WallContactTable& w = state.wall_contacts;
  for (std::size_t g = 0; g < w.grain.size(); ++g)
    for (auto k = static_cast<std::size_t>(w.begin[g]); k < static_cast<std::size_t>(w.begin[g + 1]); ++k)
      note({id(w.grain[g]), -1, w.feature[k]}, w.history.get(k));
  return stored;
}

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

constexpr int fall = 4000;  // steps after which the grains have met

}  // namespace

TEST_CASE("a grain put in mid-run falls to the bit as one that was there from the start", "[list][insert]") {
  for (const int order : {1, 4}) {
    CAPTURE(order);
    std::vector<Grain> grains = falling(order);
    const int id = static_cast<int>(grains.size());
    Experiment without(pot(order), grains, dt);
    grains.push_back({R, {0.009, 0.004, 0.45}, {0.02, -0.01, 0}, {1, 2, 3}});
    Experiment with(pot(order), grains, dt);
    with.run(fall);
    without.run(fall);
    without.step.insert(without.state, {taken_from(with, id)});
    CHECK(without.state.put_in == static_cast<std::int64_t>(grains.size()));
    CHECK(without.state.particles.count() + without.state.taken_out == without.state.put_in);
    for (int k = 0; k < 5; ++k) {
      with.run(100);
      without.run(100);
      CHECK(same(with.x(id), without.x(id)));
      CHECK(same(with.v(id), without.v(id)));
      CHECK(same(with.w(id), without.w(id)));
    }
  }
}

TEST_CASE("a grain put in lands as one that was there from the start, whatever the others are", "[list][insert]") {
  std::vector<Grain> grains{{R, {0.01, 0, 2 * R}, {}, {}}, {R, {-0.01, 0, 3 * R}, {}, {}}};
  const int id = 2;
  Experiment without(pot(), grains, dt);
  CHECK(without.state.alike);
  grains.push_back({0.7 * R, {0, 0, 0.03}, {0, 0.02, 0}, {}});
  Experiment with(pot(), grains, dt);
  with.run(fall / 2);
  without.run(fall / 2);
  without.step.insert(without.state, {taken_from(with, id)});
  CHECK_FALSE(without.state.alike);
  with.run(fall);
  without.run(fall);
  CHECK(with.touching_walls() > 0);
  CHECK(with.x(id).z < 2 * R);  // it did come down
  CHECK(norm(with.x(id) - without.x(id)) < 1e-9 * d);
}

TEST_CASE("a grain put in meets the others across a seam", "[list][insert]") {
  Scene s = hopper_material(0);
  make_sector(s, 6, AxisRule::images);
  const Symmetry sixth = Symmetry::rotation(6);
  const Vec3 first{0.02, 0.001, 0}, copy{0.02, -0.006, 0.0005};  // the copy hits the first from beyond the face
  const Vec3 second = sixth.turn_point(copy, 1), v = sixth.turn_vector({0, 0.5, 0}, 1);
  REQUIRE(sixth.turns_home(second) == 0);
  Experiment with(s, {{R, first, {}, {}}, {R, second, v, {}}}, dt), without(s, {{R, first, {}, {}}}, dt);
  with.run(20);
  without.run(20);
  REQUIRE(with.touching() == 0);
  NewGrain g = taken_from(with, 1);
  const bool home = GENERATE(true, false);
  if (!home) {  // where its copy stands: the list turns it home
    g.position = sixth.turn_point(g.position, -1);
    g.velocity = sixth.turn_vector(g.velocity, -1);
  }
  without.step.insert(without.state, {g});
  with.run(500);
  without.run(500);
  CHECK(norm(with.v(0)) > 0.1);  // they did meet
  for (const int id : {0, 1}) {
    CHECK(norm(with.x(id) - without.x(id)) < (home ? 1e-15 : 1e-12) * d);
    CHECK(norm(with.v(id) - without.v(id)) < (home ? 1e-15 : 1e-12));
  }
  CHECK(without.state.particles.turns[without.slot(1)] - with.state.particles.turns[with.slot(1)] ==
        (home ? 0 : -1));
}

TEST_CASE("putting in and taking out leaves the histories of the others to the bit", "[list][insert]") {
  for (const int order : {1, 4}) {
    CAPTURE(order);
    Experiment e(pot(order), falling(order), dt);
    e.run(fall);
    const std::map<Row, Stored> before = histories(e.state);
    REQUIRE(before.size() > 4);
    const auto through_a_seam = [](const auto& row) {
      return std::get<2>(row.first) != 0 && std::get<1>(row.first) >= 0;
    };
    REQUIRE(std::any_of(before.begin(), before.end(), through_a_seam) == (order > 1));
    NeighbourList list({e.state.symmetry.periodic() ? AxisRule::images : AxisRule::clamp, false}, 0.01 * d);
    NewGrain g{{0.01, 0.005, 0.4}, {}, {}, R, e.mass(0)};
    list.insert(e.state, {g, {{0.005, 0.01, 0.4}, {}, {}, R, e.mass(0), 0, 7, 1000}});
    CHECK(histories(e.state) == before);  // rows still name whom they named
    list.renew(e.state, dt);
    CHECK(histories(e.state) == before);
    const int next = static_cast<int>(falling(order).size());
    CHECK(norm(e.x(next) - g.position) == 0);
    CHECK(e.state.particles.layer[e.slot(1000)] == 7);
    CHECK(e.state.next_id == 1001);

    list.remove(e.state, {static_cast<Index>(e.slot(1000)), static_cast<Index>(e.slot(next))});
    list.renew(e.state, dt);
    CHECK(histories(e.state) == before);
    CHECK(e.state.taken_out == 2);
    CHECK(e.state.particles.count() + e.state.taken_out == e.state.put_in);
    list.insert(e.state, {g});  // a number is given once
    CHECK(norm(e.x(1001) - g.position) == 0);
    g.id = 3;
    CHECK_THROWS_AS(list.insert(e.state, {g}), std::logic_error);
  }
}

TEST_CASE("the energy that a grain brings is booked: the residual does not change", "[list][insert][energy]") {
  Experiment e(pot(), falling(), dt);
  e.run(fall);
  const double before = e.residual();
  const double lost_before = energy_budget(e.state.energy, e.begin, e.step.energies(e.state)).lost;
  NewGrain g{{0.01, 0.005, 0.1}, {0.3, 0.2, -1}, {10, 20, 30}, R, e.mass(0)};
  e.step.insert(e.state, {g});
  const double brought = e.mass(0) * (0.5 * 1.13 + 0.2 * R * R * 1400 + 9.81 * 0.1);
  CHECK(e.state.energy.carried_in == Approx(brought).epsilon(1e-12));
  CHECK(std::fabs(e.residual() - before) < 1e-12 * brought);
  e.run(8000);  // until it has hit the bed
  const double lost = energy_budget(e.state.energy, e.begin, e.step.energies(e.state)).lost;
  CHECK(lost - lost_before > 0.5 * brought);
  CHECK(std::fabs(e.residual() - before) < 0.02 * lost);
}

TEST_CASE("a run saved between putting in and the next step goes on to the bit", "[list][insert][checkpoint]") {
  const ScratchFolder scratch;
  const Scene scene = pot(4);
  Experiment e(scene, falling(4), dt);
  e.run(fall);
  e.step.insert(e.state, {NewGrain{{0.01, 0.005, 0.4}, {}, {}, R, e.mass(0)}});
  write_checkpoint(scratch / "checkpoint_000000000001.hdf", e.state, {"scene", "resolved", {}});
  State again = make_domain(scene);
  read_checkpoint(scratch / "checkpoint_000000000001.hdf", again);
  TimeStep step(scene, again);
  e.run(200);
  for (int k = 0; k < 200; ++k) step.advance(again, dt);
  CHECK(state_hash(again) == state_hash(e.state));
}

TEST_CASE("the first grain of an empty vessel", "[list][insert]") {
  Experiment e(pot(), {}, dt);
  e.run(3);
  e.step.insert(e.state, {NewGrain{{0.005, 0, 2 * d}, {}, {}, R, sphere_mass(R, 3800)}});
  CHECK(e.state.mean_diameter == d);
  CHECK(e.state.alike);
  e.run(20000);
  CHECK(std::fabs(e.x(0).z - R) < 0.01 * R);
  CHECK(e.state.list_builds < 2000);  // margins are those of the grain's size
}
