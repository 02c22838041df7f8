// test_analysis_slot.cpp: what wedge analyse says of a slot, where x stands for the radius, on beds with known
// answers.
#include <cmath>

#include "apps/analysis/results.hpp"
#include "tests/support/analysed_beds.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double thickness = 3.998 * d;  // four grains across it touch one another

/// 40 d wide, periodic along y, open over 8 d.
MeasuredDomain slot() {
  Scene scene = hopper_material();
  scene.domain.kind = DomainKind::slot;
  scene.domain.slot_width = thickness;
  scene.domain.gravity = {0, 0, -9.81};
  add_wall(scene, "left", {{-20 * d, 0}, {-20 * d, 60 * d}});
  add_wall(scene, "right", {{20 * d, 0}, {20 * d, 60 * d}});
  add_wall(scene, "floor_left", {{-20 * d, 0}, {-4 * d, 0}});
  add_wall(scene, "floor_right", {{4 * d, 0}, {20 * d, 0}});
  add_wall(scene, "plug", {{-4 * d, 0}, {0, 0}, {4 * d, 0}});
  return describe_domain(scene, make_domain(scene).symmetry, d);
}

/// Cells d wide and high over the whole slot and a margin outside it.
PartSums slot_sums(const MeasuredDomain& run, const Bed& bed) {
  FieldGrid grid = wide_grid(run);
  grid.left = run.left - 5 * d;
  grid.columns = 50;
  grid.slot_width = thickness;
  PartSums sums(run, make_parts(run, {}).front(), grid, mass);
  sums.add(bed);
  return sums;
}

}  // namespace

TEST_CASE("Slot: a sheet across it closes through the periodic faces: three neighbours at its edges, four inside") {
  const MeasuredDomain run = slot();
  std::vector<Grain> grains;
  const int high = 5;
  for (int k = 0; k < high; ++k)
    for (int j = 0; j < 4; ++j)
      grains.push_back({R, {3.2 * d, (j + 0.1) * thickness / 4, (5 + 0.999 * k) * d}, {}, {}});
  const PartSums sums = slot_sums(run, bed_of(run, grains));
  CHECK(count_of(sums, "cn", 3) == 2 * 4);
  CHECK(count_of(sums, "cn", 4) == (high - 2) * 4);
  CHECK(number(sums, "cn_distinct") == number(sums, "cn"));
  CHECK(number(sums, "grains") == 4 * high);  // no copies: the slot is all there is
}

TEST_CASE("Slot: velocities are along x, y and z, and rings are pairs of bars at both sides of the middle") {
  const MeasuredDomain run = slot();
  std::vector<Grain> grains;
  for (int k = 0; k < 12; ++k)
    for (const int side : {-1, 1})
      grains.push_back({R, {side * 7.25 * d, 0.3 * d * k, (5 + 1.5 * k) * d}, {side * 0.5, 0.2, -0.1}, {}});
  const Bed bed = bed_of(run, grains);
  for (std::size_t i = 0; i < grains.size(); ++i) {
    CHECK(bed.grains[i].velocity.x == grains[i].v.x);
    CHECK(bed.grains[i].velocity.y == 0.2);
    CHECK(bed.grains[i].r == Approx(7.25 * d));
  }
  const PartSums sums = slot_sums(run, bed);
  const Ring& ring = sums.rings()[14];  // 7 to 7.5 d from the middle
  CHECK(ring.grains > 8);               // those of the bulk, of both sides
  CHECK(ring.vr == Approx(0).margin(1e-12));
  CHECK(ring.vt / ring.grains == Approx(0.2));
  CHECK(ring.vz / ring.grains == Approx(-0.1));
  CHECK(std::isnan(sums.arc(7 * d)));
  // In the map the sides are apart.
  CHECK(cell_fields(sums, 17, 20).velocity.x == Approx(-0.5));
  CHECK(cell_fields(sums, 32, 20).velocity.x == Approx(0.5));
}

TEST_CASE("Slot: coarse graining of one grain is its Gaussian averaged over the width, and keeps volume") {
  const MeasuredDomain run = slot();
  const Vec3 place{-3 * d, d, 20 * d};
  const PartSums sums = slot_sums(run, bed_of(run, {{R, place, {}, {}}}));
  const double volume = mass / 3800;
  for (const int column : {20, 22, 24}) {
    for (const int row : {28, 30}) {
      const double x = sums.grid().across(column) - place.x, z = sums.grid().up(row) - place.z;
      const double plane = std::exp(-(x * x + z * z) / (2 * d * d)) / (2 * pi * d * d);
      CHECK(cell_fields(sums, column, row).packing == Approx(volume * plane / thickness).epsilon(1e-7));
    }
  }
  CHECK(over_space(sums).packing == Approx(volume).epsilon(2e-3));  // cut at four standard deviations
}

TEST_CASE("Slot: the pressure of a contact is its load times branch along x and y, none turned") {
  const MeasuredDomain run = slot();
  // One contact along (0.6, 0, 0.8) left of the middle, one along y through the faces.
  const std::vector<Grain> grains = {{R, {-8 * d, 0.5 * d, 20 * d}, {}, {}},
                                     {R, {-7.4 * d, 0.5 * d, 20.8 * d}, {}, {}},
                                     {R, {-8 * d, 3.5 * d, 20 * d}, {}, {}}};
  const PartSums sums = slot_sums(run, bed_of(run, grains, {{0, 1, 0, 5.0}, {0, 2, -1, 2.0}}));
  const CellFields whole = over_space(sums);
  CHECK(whole.prr == Approx(5 * 0.36 * d).epsilon(2e-3));
  CHECK(whole.ptt == Approx(2 * (thickness - 3 * d)).epsilon(2e-3));
  CHECK(whole.pzz == Approx(5 * 0.64 * d).epsilon(2e-3));
  CHECK(whole.prz == Approx(5 * 0.48 * d).epsilon(2e-3));
}

TEST_CASE("Slot: the angle of a ridge is found") {
  const MeasuredDomain run = slot();
  Bed bed;
  for (int i = -64; i < 64; ++i) {
    for (int j = 0; j < 16; ++j) {
      BedGrain g;
      const double x = (i + 0.5) * d / 4, top = std::tan(27 * pi / 180) * (15 * d - std::abs(x));
      g.position = {x, (j + 0.5) * d / 4, top - R};
      g.radius = R;
      g.mass = mass;
      g.r = std::abs(x);
      g.in_bed = top > 0;
      bed.grains.push_back(g);
    }
  }
  CHECK(number(slot_sums(run, bed), "angle_of_repose") == Approx(27).epsilon(1e-6));
}

TEST_CASE("Slot: the discharge rate is that of the slot itself, and Beverloo's law is not known") {
  MeasuredDomain run = slot();
  std::vector<Crossing> stream;
  for (int k = 0; k < 600; ++k) stream.push_back({1 + (k + 0.5) / 600, 0, 1});
  const std::vector<Part> parts = make_parts(run, {{4}, 4});
  REQUIRE(parts.size() == 1);  // nothing to cut wedges from
  CHECK(parts[0].regions.size() == 1);
  CHECK(discharge_rate(stream, parts[0], 1, 2).value == Approx(600));
  run.scene.stages = {Stage{}};
  run.scene.stages[0].remove = {"plug"};
  CHECK(std::isnan(beverloo_rate(run, 0.6).low));
  CHECK(run.cross_section() == Approx(40 * d * thickness));
}
