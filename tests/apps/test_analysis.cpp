// test_analysis.cpp: what wedge analyse says of grains, contacts and fields, on beds with known answers.
#include <cmath>

#include "apps/analysis/pictures.hpp"
#include "apps/analysis/results.hpp"
#include "tests/support/analysed_beds.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE(
    "A simple cubic lattice has six neighbours inside, five, four and three at its faces, edges and corners") {
  const MeasuredDomain run = vessel();
  const int n = 6;
  const PartSums touching = sums_of(run, bed_of(run, lattice(n, n, n, 0.999 * d)));
  CHECK(count_of(touching, "cn", 6) == 4 * 4 * 4);
  CHECK(count_of(touching, "cn", 5) == 6 * 4 * 4);
  CHECK(count_of(touching, "cn", 4) == 12 * 4);
  CHECK(count_of(touching, "cn", 3) == 8);
  CHECK(number(touching, "cn") == Approx(2.0 * 3 * n * n * (n - 1) / (n * n * n)));
  CHECK(number(touching, "cn_near") == number(touching, "cn"));
  CHECK(number(touching, "cn_distinct") == number(touching, "cn"));
  // Gaps of 0.003 d: near, but no contacts; of 0.007 d: neither.
  const PartSums near = sums_of(run, bed_of(run, lattice(n, n, n, 1.003 * d)));
  CHECK(number(near, "cn") == 0);
  CHECK(number(near, "cn_near") == Approx(2.0 * 3 * n * n * (n - 1) / (n * n * n)));
  CHECK(number(near, "rattlers") == 1);
  CHECK(number(sums_of(run, bed_of(run, lattice(n, n, n, 1.007 * d))), "cn_near") == 0);
}

TEST_CASE("Rattlers are left out of the mechanical coordination number") {
  const MeasuredDomain run = vessel();
  // A chain of four grains and a lonely one: contacts 1, 2, 2, 1, 0.
  std::vector<Grain> grains = lattice(4, 1, 1, 0.999 * d);
  grains.push_back({R, {0, 10 * d, 5 * d}, {}, {}});
  const PartSums sums = sums_of(run, bed_of(run, grains));
  CHECK(number(sums, "cn") == Approx(6.0 / 5));
  CHECK(number(sums, "rattlers") == Approx(3.0 / 5));
  CHECK(number(sums, "cn_without_rattlers") == 2);
  CHECK(count_of(sums, "cn_without_rattlers", 2) == 2);
  CHECK(sums.histogram(0, kind(sums, "cn_without_rattlers")).total() == 2);
}

TEST_CASE(
    "Across the seam both ends count, and a neighbour met directly and through the seam is one distinct "
    "neighbour") {
  const MeasuredDomain run = vessel(4);  // 90 degrees
  // Near the faces phi = 0 and 90 degrees, 8 d from the axis: neighbours through the seam.
  const std::vector<Grain> seam = {{R, {8 * d, 0.49 * d, 5 * d}, {}, {}}, {R, {0.49 * d, 8 * d, 5 * d}, {}, {}}};
  const Bed pair = bed_of(run, seam);
  CHECK(pair.contacts.size() == 1);
  for (const BedGrain& g : pair.grains) {
    CHECK(g.cn == 1);
    CHECK(g.cn_near == 1);
    CHECK(g.cn_distinct == 1);
  }
  // Two grains 1.2 R from the axis, at 22.5 and 67.5 degrees: one way they are 0.92 R apart ... so set them at
  // different heights, such that both the direct contact and those through the seam hold.
  const double r = 0.9 * R, rise = 1.5 * R, a = pi / 8;
  const std::vector<Grain> near_axis = {{R, {r * std::cos(a), r * std::sin(a), 5 * d}, {}, {}},
                                        {R, {r * std::sin(a), r * std::cos(a), 5 * d + rise}, {}, {}}};
  const Bed both = bed_of(run, near_axis);
  CHECK(both.contacts.size() == 2);  // directly, and through one face
  for (const BedGrain& g : both.grains) {
    CHECK(g.cn == 2);
    CHECK(g.cn_distinct == 1);
  }
}

TEST_CASE("A contact with one's own copy half a turn away counts once, with another copy twice") {
  const MeasuredDomain half = vessel(2, AxisRule::images);
  CHECK(bed_of(half, {{R, {0, 0.99 * R, 5 * d}, {}, {}}}).grains[0].cn == 1);
  const MeasuredDomain third = vessel(3, AxisRule::images);
  const double r = 0.99 * R / std::sin(pi / 3);  // three copies touch one another
  CHECK(bed_of(third, {{R, {r * 0.5, r * std::sqrt(0.75), 5 * d}, {}, {}}}).grains[0].cn == 2);
}

TEST_CASE("Velocities of a bed that turns, spreads and sinks are found by grain, ring, cell and bin") {
  const MeasuredDomain run = vessel();
  const double turn = 3, spread = 0.7, sink = 0.02;  // 1/s, 1/s, m/s
  std::vector<Grain> grains = lattice(24, 24, 20, 1.2 * d);
  for (Grain& g : grains) g.v = {-turn * g.x.y + spread * g.x.x, turn * g.x.x + spread * g.x.y, -sink};
  const Bed bed = bed_of(run, grains);
  for (const BedGrain& g : bed.grains) {
    CHECK(g.velocity.x == Approx(spread * g.r));
    CHECK(g.velocity.y == Approx(turn * g.r));
  }
  const PartSums sums = sums_of(run, bed);
  CHECK(number(sums, "vz") == Approx(-sink));
  double squares = 0;
  for (const BedGrain& g : bed.grains) squares += (turn * turn + spread * spread) * g.r * g.r + sink * sink;
  CHECK(number(sums, "speed") == Approx(std::sqrt(squares / static_cast<double>(grains.size()))));
  const auto& counts = sums.histogram(0, kind(sums, "vz")).counts();
  REQUIRE(counts.size() == 1);
  const Bins& bins = sums.kinds()[kind(sums, "vz")].bins;
  CHECK(bins.edge(counts.begin()->first) <= -sink);
  CHECK(bins.edge(counts.begin()->first + 1) > -sink);
  const Ring& ring = sums.rings()[11];  // 5.5 to 6 d from the axis
  CHECK(ring.vt / ring.grains == Approx(turn * 5.75 * d).epsilon(0.04));
  CHECK(ring.vz / ring.grains == Approx(-sink));
  const CellFields cell = cell_fields(sums, 7, 20);  // at r = 7.5 d; a Gaussian ring reaches a little outwards
  CHECK(cell.velocity.z == Approx(-sink));
  CHECK(cell.velocity.y == Approx(turn * 7.5 * d).epsilon(0.04));
  CHECK(cell.velocity.x / cell.velocity.y == Approx(spread / turn).epsilon(1e-9));
}

TEST_CASE("Coarse graining of one grain is its Gaussian averaged over azimuth, and keeps volume") {
  const MeasuredDomain run = vessel();
  const Vec3 place{3 * d, 4 * d, 20 * d};
  const PartSums sums = sums_of(run, bed_of(run, {{R, place, {}, {}}}));
  const double volume = mass / 3800;
  for (const int column : {1, 3, 5, 7}) {
    for (const int row : {28, 30}) {
      const double r = sums.grid().across(column), z = sums.grid().up(row);
      double mean = 0;  // over azimuth, of the Gaussian in space
      const int steps = 720;
      for (int k = 0; k < steps; ++k) {
        const Vec3 at{r * std::cos(2 * pi * k / steps), r * std::sin(2 * pi * k / steps), z};
        const Vec3 way = at - place;
        mean += std::exp(-dot(way, way) / (2 * d * d)) / std::pow(2 * pi * d * d, 1.5) / steps;
      }
      CHECK(cell_fields(sums, column, row).packing == Approx(volume * mean).epsilon(1e-5));
    }
  }
  CHECK(over_space(sums).packing == Approx(volume).epsilon(2e-3));  // cut at four standard deviations
}

TEST_CASE("I0e is the mean of exp(x (cos phi - 1)) over phi") {
  for (const double x : {0.0, 0.3, 2.0, 3.7, 3.8, 20.0, 400.0}) {
    double mean = 0;
    const int steps = 20000;
    for (int k = 0; k < steps; ++k) mean += std::exp(x * (std::cos(2 * pi * k / steps) - 1)) / steps;
    CHECK(scaled_bessel_i0(x) == Approx(mean).epsilon(3e-7));
  }
}

TEST_CASE("A lattice fills space with its packing fraction, in the map and in the bulk") {
  const MeasuredDomain run = vessel();
  const double spacing = 1.1 * d;
  std::vector<Grain> grains;
  for (const Grain& g : lattice(36, 36, 30, spacing))
    if (std::hypot(g.x.x, g.x.y) < 19.5 * d) grains.push_back(g);
  const PartSums sums = sums_of(run, bed_of(run, grains));
  const double packing = pi / 6 * std::pow(d / spacing, 3);
  for (const int column : {3, 8, 12}) CHECK(cell_fields(sums, column, 27).packing == Approx(packing).epsilon(0.02));
  // The shell is half a grain wider than the centres.
  CHECK(number(sums, "packing") == Approx(packing).epsilon(0.06));
}

TEST_CASE("A sector has the fields, rings and numbers of the full vessel that it unfolds to") {
  const int order = 6;
  const MeasuredDomain sector = vessel(order), full = vessel();
  std::vector<Grain> part, whole;
  for (Grain g : lattice(20, 20, 6, 0.999 * d)) {
    g.x = g.x + Vec3{0.137 * d, 0.071 * d, 0};
    g.v = {0.1 * g.x.x, -0.3 * g.x.y, 0.02 * g.x.z};
    const double azimuth = std::atan2(g.x.y, g.x.x);
    if (azimuth < 0.03 || azimuth >= 2 * pi / order - 0.03 || std::hypot(g.x.x, g.x.y) < 4 * d) continue;
    part.push_back(g);
    for (int k = 0; k < order; ++k) {
      Grain turned = g;
      turned.x = sector.symmetry.turn_vector(g.x, k);
      turned.v = sector.symmetry.turn_vector(g.v, k);
      whole.push_back(turned);
    }
  }
  REQUIRE(part.size() > 100);
  const PartSums a = sums_of(sector, bed_of(sector, part)), b = sums_of(full, bed_of(full, whole));
  for (const char* name : {"grains", "cn", "cn_near", "cn_distinct", "vr", "vt", "vz", "speed", "axis_mass_2d",
                           "rattlers", "bed_height"})
    CHECK(number(a, name) == Approx(number(b, name)).margin(1e-12));
  // Quantiles of height fall on other grains of the same layers.
  CHECK(number(a, "packing") == Approx(number(b, "packing")).epsilon(0.005));
  for (const int column : {0, 5, 9}) {
    const CellFields x = cell_fields(a, column, 14), y = cell_fields(b, column, 14);
    CHECK(x.packing == Approx(y.packing).epsilon(1e-6));
    CHECK(x.grains == Approx(y.grains).epsilon(1e-6));
    CHECK(x.velocity.y == Approx(y.velocity.y).epsilon(1e-6));
    CHECK(x.cn == Approx(y.cn).epsilon(1e-6));
  }
  CHECK(a.rings()[13].grains == b.rings()[13].grains);
}

TEST_CASE("Three spheres in a ring: forces, loads and the pressure tensor of a known network") {
  const MeasuredDomain run = vessel();
  // Centres at 8 d from the axis in the plane y = 0, a triangle (x, z): (8, 20), (9, 20), (8.5, 20 + sqrt(3)/2) d.
  const double top = std::sqrt(0.75);
  const std::vector<Grain> grains = {
      {R, {8 * d, 0, 20 * d}, {}, {}}, {R, {9 * d, 0, 20 * d}, {}, {}}, {R, {8.5 * d, 0, (20 + top) * d}, {}, {}}};
  const Bed bed = bed_of(run, grains, {{0, 1, 0, 2.0}, {0, 2, 0, 3.0}, {1, 2, 0, 5.0}});
  // Pushed apart: grain 0 by 2 along -x and by 3 along -(1/2, top); and so on.
  CHECK(bed.grains[0].normal_force.x == Approx(-2 - 1.5));
  CHECK(bed.grains[0].normal_force.z == Approx(-3 * top));
  CHECK(bed.grains[1].normal_force.x == Approx(2 + 2.5));
  CHECK(bed.grains[1].normal_force.z == Approx(-5 * top));
  CHECK(bed.grains[2].normal_force.x == Approx(1.5 - 2.5));
  CHECK(bed.grains[2].normal_force.z == Approx(8 * top));
  CHECK(bed.grains[2].normal_force.y == Approx(0).margin(1e-12));
  const PartSums sums = sums_of(run, bed);
  CHECK(number(sums, "load") == Approx(10.0 / 3));
  CHECK(number(sums, "cn") == 2);
  CHECK(sums.histogram(0, kind(sums, "load")).total() == 3);
  const CellFields whole = over_space(sums);
  // The integral over space is the sum of load times branch, d long, in its directions (Goldhirsch 2010).
  CHECK(whole.prr == Approx(d * (2 + 3 * 0.25 + 5 * 0.25)).epsilon(2e-3));
  CHECK(whole.pzz == Approx(d * (3 + 5) * 0.75).epsilon(2e-3));
  CHECK(whole.prz == Approx(d * (3 - 5) * 0.5 * top).epsilon(2e-3));
  CHECK(whole.ptt == Approx(0).margin(1e-9));
  const SlicePicture picture = slice_picture(run, bed);
  CHECK(picture.grains.size() == 3);
  REQUIRE(picture.lines.size() == 3);
  CHECK(picture.lines[2].load == 5);
  CHECK(norm(picture.lines[2].to - picture.lines[2].from) == Approx(d));
}

TEST_CASE("Pressure: a sector with contacts across its seam has that of the full vessel it unfolds to") {
  const MeasuredDomain sector = vessel(4, AxisRule::images), full = vessel();
  // A pair through the seam, one inside, and the halves of a contact half a turn away.
  const std::vector<Grain> part = {{R, {8 * d, 0.5 * d, 5 * d}, {}, {}},
                                   {R, {0.5 * d, 8 * d, 5.2 * d}, {}, {}},
                                   {R, {1.0 * d, 8.5 * d, 5.6 * d}, {}, {}},
                                   {R, {0.3 * d, 0.4 * d, 6 * d}, {}, {}}};
  const std::vector<Touch> touches = {{0, 1, -1, 7.0}, {1, 2, 0, 3.0}, {3, 3, 2, 5.0}};
  std::vector<Grain> whole;
  std::vector<Touch> all;
  for (int k = 0; k < 4; ++k) {
    for (Grain g : part) {
      g.x = sector.symmetry.turn_vector(g.x, k);
      whole.push_back(g);
    }
    // Grain i of copy k is 4 k + i; grain 1 seen one turn back from copy k is that of copy k - 1.
    all.push_back({4 * k, 4 * ((k + 3) % 4) + 1, 0, 7.0});
    all.push_back({4 * k + 1, 4 * k + 2, 0, 3.0});
  }
  all.push_back({3, 11, 0, 5.0});  // once for copies 0 and 2, once for 1 and 3
  all.push_back({7, 15, 0, 5.0});
  const PartSums a = sums_of(sector, bed_of(sector, part, touches)), b = sums_of(full, bed_of(full, whole, all));
  for (const int column : {0, 1, 6, 8}) {
    const CellFields x = cell_fields(a, column, 15), y = cell_fields(b, column, 15);
    CHECK(x.prr == Approx(y.prr).epsilon(1e-6));
    CHECK(x.ptt == Approx(y.ptt).epsilon(1e-6));
    CHECK(x.pzz == Approx(y.pzz).epsilon(1e-6));
    CHECK(x.prz == Approx(y.prz).epsilon(1e-6));
    CHECK(x.prr != 0);
  }
}

TEST_CASE("The force through the seam turns with the grain it acts on") {
  const MeasuredDomain run = vessel(4);
  const std::vector<Grain> grains = {{R, {8 * d, 0.5 * d, 5 * d}, {}, {}}, {R, {0.5 * d, 8 * d, 5 * d}, {}, {}}};
  const Bed bed = bed_of(run, grains, {{0, 1, -1, 7.0}});  // the second as seen at (8, -0.5) d
  const double across = 8 / std::hypot(8, 0.5);            // of the unit vector e_t along y
  CHECK(bed.grains[0].normal_force.y == Approx(7 * across));
  CHECK(bed.grains[1].normal_force.y == Approx(-7 * across));
  CHECK(bed.grains[0].normal_force.x == Approx(bed.grains[1].normal_force.x));
}

TEST_CASE("The kinetic part of the pressure is rho times the mean square of the velocity about the mean") {
  const MeasuredDomain run = vessel();
  std::vector<Grain> grains = lattice(24, 24, 20, 1.2 * d);
  for (std::size_t i = 0; i < grains.size(); ++i) grains[i].v = {0, 0, 1 + (i % 2 == 0 ? 0.1 : -0.1)};
  const PartSums sums = sums_of(run, bed_of(run, grains, {{0, 1, 0, 0.0}}));
  const CellFields c = cell_fields(sums, 5, 20);
  CHECK(c.pzz == Approx(3800 * c.packing * 0.01).epsilon(1e-3));
  CHECK(c.velocity.z == Approx(1).epsilon(1e-3));
}
