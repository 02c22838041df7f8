// test_bed_table.cpp: measures of beds with known answers, and the table of beds.
#include <limits>

#include "apps/run/bed_table.hpp"
#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/scratch_folder.hpp"

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
  const StageResult result = measure_bed(bed.state, scene, "lattice", 0, 0);
  CHECK(quantity(result, "packing fraction") == Approx(pi / 6 * d / spacing).epsilon(1e-9));
  const double pairs = 2 * (11 * 12 * 10) + 12 * 12 * 9;
  CHECK(quantity(result, "coordination number") == Approx(2 * pairs / 1440));
  CHECK(quantity(result, "grains") == 1440);
  CHECK(quantity(result, "bed height") == Approx(9 * spacing + R));
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
  const StageResult result = measure_bed(bed.state, scene, "now", 2.5, 7);
  const double mass = sphere_mass(R, 3800);
  CHECK(quantity(result, "grains") == 12);
  CHECK(quantity(result, "grains discharged") == 12);
  CHECK(quantity(result, "discharge rate") == 10);
  CHECK(quantity(result, "wall time") == 7);
  CHECK(quantity(result, "coordination number") == Approx(2.0 / 3));
  CHECK(quantity(result, "weight of all grains") == Approx(12 * mass * 9.81));
  CHECK(quantity(result, "kinetic energy per grain") == Approx(0.5 * mass * 0.01 / 3));
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
  CHECK(quantity(measure_bed(bed.state, scene, "pair", 0, 0), "coordination number") == 1);
}

TEST_CASE("The angle of repose of a cone is the angle of its side") {
  Scene scene = hopper_material();
  add_wall(scene, "plate", {{0, 0}, {25 * d, 0}});
  for (const double degrees : {12.0, 30.0}) {
    const State pile = make_state(scene, cone(20 * d, std::tan(degrees * pi / 180)));
    CHECK(quantity(measure_bed(pile, scene, "pile", 0, 0), "angle of repose") == Approx(degrees).epsilon(1e-9));
  }
}

TEST_CASE("A flat bed and an empty vessel have no angle of repose") {
  Scene scene = hopper_material();
  add_wall(scene, "plate", {{0, 0}, {25 * d, 0}});
  const State flat = make_state(scene, lattice(12, 12, 3, d));
  CHECK(std::isnan(quantity(measure_bed(flat, scene, "flat", 0, 0), "angle of repose")));
  const StageResult empty = measure_bed(make_state(scene, {}), scene, "empty", 0, 0);
  CHECK(std::isnan(quantity(empty, "angle of repose")));
  CHECK(std::isnan(quantity(empty, "packing fraction")));
  CHECK(std::isnan(quantity(empty, "kinetic energy per grain")));
  CHECK(quantity(empty, "grains") == 0);
}

TEST_CASE("A table of beds reads back as it was written") {
  const ScratchFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<StageResult> stages = {
      {"settle", {{"time", "s", 1.0 / 3}, {"grains", "", 8000}, {"load on \"a, b\"", "N", -0.0}}},
      {"open, then wait", {{"time", "s", 2e-9}, {"grains", "", 0}, {"load on \"a, b\"", "N", nan}}}};
  write_bed_table(folder / "beds.csv", stages);
  const std::vector<StageResult> back = read_bed_table(folder / "beds.csv");
  REQUIRE(back.size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    CHECK(back[s].stage == stages[s].stage);
    REQUIRE(back[s].quantities.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const BedQuantity &a = back[s].quantities[k], &b = stages[s].quantities[k];
      CHECK(a.name == b.name);
      CHECK(a.unit == b.unit);
      CHECK((a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))));
    }
  }
}

TEST_CASE("A table of beds that is none is refused with its place") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(read_bed_table(folder / "none.csv"), FileError);
  for (const char* text : {"", "time [s]\n1\n", "stage,time [s]\na,1,2\n", "stage,time [s]\na,soon\n"}) {
    write_text_file_atomically(folder / "beds.csv", text);
    CHECK_THROWS_AS(read_bed_table(folder / "beds.csv"), FileError);
  }
}

TEST_CASE("The picture of a slice is small, scales and is closed") {
  const ScratchFolder folder;
  Scene scene = hopper_material();
  add_wall(scene, "shell", {{20 * d, 0}, {20 * d, 30 * d}});
  std::vector<Grain> grains = lattice(30, 5, 30, d);
  for (Grain& g : grains) g.x = g.x + Vec3{-15 * d, -2 * d, R}, g.x.y *= 0.9, g.v = {0, 0, g.x.z};
  scene.name = "pile";
  write_slice_svg(folder / "slice.svg", make_state(scene, grains), scene, "a <small> & simple \"bed\"");
  const std::string svg = read_text_file(folder / "slice.svg");
  CHECK(svg.size() < 66 * grains.size() + 12000);
  CHECK(svg.find("viewBox=") != std::string::npos);
  CHECK(svg.find("<title>pile, full vessel, a &lt;small&gt; &amp; simple \"bed\", t = 0 s</title>") !=
        std::string::npos);
  CHECK(svg.substr(svg.size() - 7) == "</svg>\n");
  std::size_t circles = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++circles;
  CHECK(circles == grains.size());
}
