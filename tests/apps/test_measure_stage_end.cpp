// test_measure_stage_end.cpp: the row of beds.csv of beds with known answers.
#include <set>

#include "apps/measure/bed_numbers.hpp"
#include "apps/measure/stage_end.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double R = 0.0025, d = 2 * R;

double quantity(const StageResult& result, const std::string& name) {
  for (const BedQuantity& q : result.quantities)
    if (q.name == name) return q.value;
  FAIL("no quantity " << name);
  return 0;
}

StageResult measured(const State& state, const Scene& scene, const FinishedStage& stage = {"now", 0, 0},
                     const std::vector<Crossing>& crossings = {}) {
  return measure_stage_end(state, describe_domain(scene, state.symmetry, state.mean_diameter), stage, crossings);
}

/// nx x ny x nz grains at distance `spacing`, the first at the origin.
std::vector<Grain> lattice(int nx, int ny, int nz, double spacing) {
  std::vector<Grain> grains;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) grains.push_back({R, {i * spacing, j * spacing, k * spacing}, {}, {}});
  return grains;
}

/// A pile on a plate: a grain on every point of a lattice of d/4 with its top on the cone z = slope (r_max - r).
std::vector<Grain> cone(double r_max, double slope) {
  std::vector<Grain> grains;
  const int n = static_cast<int>(4 * r_max / d);
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j) {
      const double x = i * d / 4, y = j * d / 4, top = slope * (r_max - std::hypot(x, y));
      if (top > 0) grains.push_back({R, {x, y, top - R}, {}, {}});
    }
  return grains;
}

}  // namespace

TEST_CASE("A simple cubic lattice has the packing fraction pi/6 and its contacts counted at both ends") {
  Scene scene = hopper_material();
  add_wall(scene, "shell", {{8 * d, 0}, {8 * d, 1}});
  // As wide as the square of the lattice: 12 x 12 cells have the area of a circle of radius 12 d / sqrt(pi).
  scene.walls[0].profile = {{12 * d / std::sqrt(pi), 0}, {12 * d / std::sqrt(pi), 1}};
  const double spacing = 0.999 * d;  // so that neighbours touch
  std::vector<Grain> grains = lattice(12, 12, 10, spacing);
  for (Grain& g : grains) g.x = g.x + Vec3{-5.5 * spacing, -5.5 * spacing, 0};
  scene.walls[0].present = false;  // the corners of the square stick out of the shell, which only tells the width
  Experiment bed(scene, grains, 1e-6);
  const StageResult result = measured(bed.state, scene);
  CHECK(quantity(result, "packing") == Approx(pi / 6 * d / spacing).epsilon(1e-9));
  const double pairs = 2 * (11 * 12 * 10) + 12 * 12 * 9;
  CHECK(quantity(result, "cn") == Approx(2 * pairs / 1440));
  CHECK(quantity(result, "grains") == 1440);
  CHECK(quantity(result, "bed_height") == Approx(9 * spacing + R));
}

TEST_CASE("A sector's quantities are those of the whole vessel") {
  Scene scene = hopper_material();
  scene.domain.gravity = {0, 0, -9.81};
  make_sector(scene, 4, AxisRule::clamp);
  add_wall(scene, "floor", {{0, 0}, {10 * d, 0}});
  // Two grains that touch the floor, one of them its neighbour's image across the seam, and one above.
  const double r = 4 * d, half = std::asin(0.4995 * d / r);
  const auto at = [&](double phi, double z) { return Vec3{r * std::cos(phi), r * std::sin(phi), z}; };
  const std::vector<Grain> grains = {{R, at(half, 0.999 * R), {}, {}},
                                     {R, at(pi / 2 - half, 0.999 * R), {}, {}},
                                     {R, at(pi / 4, 5 * R), {0, 0, -0.1}, {}}};
  Experiment bed(scene, grains, 1e-6);
  bed.state.taken_out = 3;
  bed.state.time = 4;
  // Five crossed in the two seconds of the stage, each for four sectors.
  const std::vector<Crossing> crossings = {{1.9, 0, 4}, {2.1, 0, 4}, {2.2, 0, 4},
                                           {2.3, 0, 4}, {3, 0, 4},   {4, 0, 4}};
  const StageResult result = measured(bed.state, scene, {"now", 2, 7}, crossings);
  const double mass = sphere_mass(R, 3800);
  CHECK(quantity(result, "grains") == 12);
  CHECK(quantity(result, "grains_discharged") == 12);
  CHECK(quantity(result, "discharge_rate") == 10);
  CHECK(quantity(result, "wall_time") == 7);
  CHECK(quantity(result, "cn") == Approx(2.0 / 3));
  CHECK(quantity(result, "weight_of_grains") == Approx(12 * mass * 9.81));
  CHECK(quantity(result, "kinetic_energy_per_grain") == Approx(0.5 * mass * 0.01 / 3));
  // Hertz on a flat wall: 4/3 E* sqrt(R) overlap^(3/2), E* = E / (2 (1 - nu^2)); eight such grains in the whole
  // vessel.
  const double overlap = 0.001 * R, modulus = 1e7 / (2 * (1 - 0.09));
  CHECK(quantity(result, "load on floor") ==
        Approx(8 * 4.0 / 3 * modulus * std::sqrt(R) * std::pow(overlap, 1.5)).epsilon(1e-6));
}

TEST_CASE("A grain's contact with its own copy half a turn away counts once") {
  Scene scene = hopper_material();
  make_sector(scene, 2, AxisRule::images);
  Experiment bed(scene, {{R, {0, 0.99 * R, 0}, {}, {}}}, 1e-6);
  REQUIRE(bed.touching() == 1);
  CHECK(quantity(measured(bed.state, scene), "cn") == 1);
}

TEST_CASE("The angle of repose of a cone is the angle of its side") {
  Scene scene = hopper_material();
  add_wall(scene, "plate", {{0, 0}, {25 * d, 0}});
  for (const double degrees : {12.0, 30.0}) {
    const State pile = make_state(scene, cone(20 * d, std::tan(degrees * pi / 180)));
    CHECK(quantity(measured(pile, scene), "angle_of_repose") == Approx(degrees).epsilon(1e-9));
  }
}

TEST_CASE("A flat bed and an empty vessel have no angle of repose") {
  Scene scene = hopper_material();
  add_wall(scene, "plate", {{0, 0}, {25 * d, 0}});
  const State flat = make_state(scene, lattice(12, 12, 3, d));
  CHECK(std::isnan(quantity(measured(flat, scene), "angle_of_repose")));
  const StageResult empty = measured(make_state(scene, {}), scene);
  CHECK(std::isnan(quantity(empty, "angle_of_repose")));
  CHECK(std::isnan(quantity(empty, "packing")));
  CHECK(std::isnan(quantity(empty, "kinetic_energy_per_grain")));
  CHECK(quantity(empty, "grains") == 0);
}

TEST_CASE("The row of beds.csv has the quantities of the vocabulary, each wall's load by itself") {
  Scene scene = hopper_material();
  add_wall(scene, "floor", {{0, 0}, {10 * d, 0}});
  add_wall(scene, "shell", {{10 * d, 0}, {10 * d, 1}});
  std::set<std::string> found, expected;
  for (const BedQuantity& q : measured(make_state(scene, lattice(2, 2, 2, d)), scene).quantities) {
    found.insert(q.name);
    const bool load = q.name.rfind("load on ", 0) == 0;
    CHECK(q.unit == quantity(load ? "wall_load" : q.name).unit);
  }
  for (const ResultQuantity* q : quantities_in(in_beds))
    if (q->name != std::string("wall_load")) expected.insert(q->name);
  expected.insert({"load on floor", "load on shell"});
  CHECK(found == expected);
}

TEST_CASE("Grains below what the bed stands on are not of the bed, at a stage's end as in an analysis") {
  Scene scene = hopper_material();
  add_wall(scene, "plate", {{0, 0}, {25 * d, 0}});
  std::vector<Grain> grains = lattice(4, 4, 3, 0.999 * d);
  for (Grain& g : grains) g.x.z += R;
  const std::size_t on_plate = grains.size();
  for (int k = 1; k <= 5; ++k) grains.push_back({R, {0, 0, -10 * k * d}, {}, {}});  // they fall
  Experiment bed(scene, grains, 1e-6);
  const StageResult row = measured(bed.state, scene);
  CHECK(quantity(row, "grains") == static_cast<double>(on_plate));
  const MeasuredDomain domain = describe_domain(scene, bed.state.symmetry, bed.state.mean_diameter);
  const std::vector<Scalar> numbers =
      bed_numbers(domain, bed_of_frame(domain, bed.state, nullptr), whole_part(domain));
  for (const char* name : {"grains", "packing", "cn", "bed_height"})
    CHECK(quantity(row, name) == value_of(numbers, name));
}
