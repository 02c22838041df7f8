// test_analysis_numbers.cpp: numbers that wedge analyse draws from a bed or a discharge: angle of repose, mass at
// the axis, lines, bins, regions, rates, zones; and its pictures.
#include <cmath>

#include "apps/analysis/pictures.hpp"
#include "apps/analysis/results.hpp"
#include "apps/measure/flank.hpp"
#include "tests/support/analysed_beds.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("The angle of a cone is found, with no scatter over azimuth, and of a cone of two slopes with theirs") {
  const MeasuredDomain run = vessel();
  const auto cone = [&](double left, double right) {
    Bed bed;
    for (int i = -64; i <= 64; ++i) {
      for (int j = -64; j <= 64; ++j) {
        BedGrain g;
        const double slope = std::tan((i < 0 ? left : right) * pi / 180);
        const double x = (i + 0.5) * d / 4, y = (j + 0.5) * d / 4, top = slope * (15 * d - std::hypot(x, y));
        g.position = {x, y, top - R};
        g.radius = R;
        g.mass = mass;
        g.r = std::hypot(x, y);
        g.azimuth = std::atan2(y, x) < 0 ? std::atan2(y, x) + 2 * pi : std::atan2(y, x);
        g.in_bed = top > 0;
        bed.grains.push_back(g);
      }
    }
    return bed;
  };
  const PartSums even = sums_of(run, cone(27, 27));
  CHECK(number(even, "angle_of_repose") == Approx(27).epsilon(1e-6));
  CHECK(number(even, "angle_of_repose_scatter") == Approx(0).margin(0.05));
  const PartSums uneven = sums_of(run, cone(20, 30));
  CHECK(number(uneven, "angle_of_repose_scatter") == Approx(5 * std::sqrt(12.0 / 11)).epsilon(0.03));
  for (const Scalar& s : uneven.scalars()) {
    if (s.quantity != &quantity("angle_of_repose")) continue;
    CHECK(s.estimate.value == Approx(25).epsilon(0.02));
    CHECK(s.estimate.high - s.estimate.low == Approx(2 * 1.96 * 5.22 / std::sqrt(12.0)).epsilon(0.03));
  }
}

TEST_CASE("What lies beyond a gap or a step up is not of the flank") {
  std::vector<Eigen::Vector2d> cone;
  for (int k = 0; k < 12; ++k) cone.emplace_back((k + 0.5) * d, std::tan(28 * pi / 180) * (12 - k) * d);
  const double alone = angle_of_repose(cone, 0, d);
  CHECK(alone == Approx(28).epsilon(1e-9));
  std::vector<Eigen::Vector2d> stuck = cone, far = cone;
  stuck[9].y() = stuck[10].y() = 5 * d;  // grains caught beside the pile, higher than its foot
  CHECK(angle_of_repose(stuck, 0, d) == Approx(28).epsilon(1e-9));
  far.erase(far.begin() + 8, far.begin() + 10);
  for (std::size_t k = 8; k < far.size(); ++k) far[k].y() = 2 * d;
  CHECK(angle_of_repose(far, 0, d) == Approx(28).epsilon(1e-9));
}

TEST_CASE("Mass at the axis: grains inside d and 2 d over the height of the bulk") {
  const MeasuredDomain run = vessel(4);
  std::vector<Grain> grains;
  for (int k = 0; k <= 100; ++k) {
    const double z = (5 + 0.4 * k) * d;
    grains.push_back({R, {0.5 * d, 0.5 * d, z}, {}, {}});            // r = 0.71 d
    grains.push_back({R, {1.2 * d, 0.8 * d, z + 0.1 * d}, {}, {}});  // r = 1.44 d
    grains.push_back({R, {9 * d, 3 * d, z + 0.2 * d}, {}, {}});
  }
  Bed bed;
  for (const Grain& g : grains) {
    BedGrain b;
    b.position = g.x;
    b.r = std::hypot(g.x.x, g.x.y);
    b.azimuth = std::atan2(g.x.y, g.x.x);
    b.radius = R;
    b.mass = mass;
    b.weight = 4;
    b.in_bed = b.in_bulk = true;
    bed.grains.push_back(b);
  }
  bed.bulk_low = 5 * d;
  bed.bulk_high = 45 * d;
  const PartSums sums = sums_of(run, bed);
  CHECK(number(sums, "axis_mass_1d") == Approx(4 * 101 * mass / (40 * d)));
  CHECK(number(sums, "axis_mass_2d") == Approx(4 * 202 * mass / (40 * d)));
}

TEST_CASE(
    "The line through coordination numbers against arc is that of the data, and its interval shrinks with them") {
  LineSums line;
  for (int k = 0; k <= 40; ++k) line.add(0.1 * k, 2.5 + 0.7 * 0.1 * k);
  const auto [slope, intercept] = line.fit(1);
  CHECK(slope.value == Approx(0.7));
  CHECK(intercept.value == Approx(2.5));
  CHECK(slope.high - slope.low == Approx(0).margin(1e-6));
  LineSums noisy;  // residuals of +-0.2: standard error of the slope 0.2 / sqrt(sum (x - mean)^2)
  double squares = 0;
  for (int k = 0; k < 400; ++k) {
    const double x = 0.01 * (k / 2);
    noisy.add(x, 1 + x + (k % 2 == 0 ? 0.2 : -0.2));
    squares += (x - 0.995) * (x - 0.995);
  }
  CHECK(noisy.fit(1).first.high - noisy.fit(1).first.value ==
        Approx(1.96 * 0.2 / std::sqrt(squares)).epsilon(0.01));
}

TEST_CASE("The paper's correction: CN0 over the line below an arc of 4 d, one above") {
  const MeasuredDomain run = vessel(8);  // 45 degrees
  Bed bed;
  for (const double r : {1.0, 12.0, 14.0}) {
    BedGrain g;
    g.r = r * d;
    g.azimuth = 0.1;
    g.position = {r * d, 0, 5 * d};
    g.radius = R;
    g.in_bed = g.in_bulk = true;
    g.cn = g.cn_distinct = r > 10 ? 6 : 3;
    bed.grains.push_back(g);
  }
  const PartSums sums = sums_of(run, bed);
  CHECK(sums.outer_cn() == 6);
  const double arc = 2 * pi / 8;
  CHECK(sums.arc(d) == Approx(arc));
  CHECK(sums.correction(d) == Approx(6 / ((6.0 / 3 - 1) * arc + 4 - 6.0 / 3)));
  CHECK(sums.correction(12 * d) == 1);
}

TEST_CASE("Bins are even near zero, of even ratio far away, and hold what lies between their edges") {
  const Bins bins{0.01, 0.1}, whole{};
  for (const double value : {-3.0, -0.011, -1e-9, 0.0, 1e-9, 0.0005, 0.2, 7.0}) {
    CHECK(bins.edge(bins.bin(value)) <= value + 1e-15);
    CHECK(bins.edge(bins.bin(value) + 1) > value);
  }
  CHECK(bins.edge(1) == Approx(0.001).epsilon(0.01));
  CHECK(bins.edge(61) / bins.edge(60) == Approx(std::exp(0.1)).epsilon(1e-3));
  CHECK(whole.bin(5) == 5);
  CHECK(whole.edge(5) == 4.5);
}

TEST_CASE("Regions and wedges: axis zone and rest at 4 d over the angle, wedges side by side around the vessel") {
  const MeasuredDomain full = vessel(), sector = vessel(4);
  const std::vector<Part> own = make_parts(sector, {{4, 8}, 3});
  REQUIRE(own.size() == 1);  // wedges are cut from full vessels
  REQUIRE(own[0].regions.size() == 3);
  CHECK(name_of(own[0].regions[1].id) == "axis_zone_n4");
  CHECK(own[0].regions[1].to == Approx(4 * d / (pi / 2)));
  CHECK(own[0].regions[2].holds(4 * d));
  const std::vector<Part> parts = make_parts(full, {{4, 8, 24}, 4});
  REQUIRE(parts.size() == 1 + 12);
  CHECK(parts[0].regions.size() == 1 + 2 * 3);
  CHECK(name_of(parts[5].id) == "wedge_n8_0");
  CHECK(parts[9].regions.size() == 3);  // 15 degrees: the axis zone ends at 15.3 d of 20
  for (int k = 0; k < 1000; ++k) {      // the four wedges of 90 degrees hold every azimuth once
    int held = 0;
    for (int w = 1; w <= 4; ++w) held += parts[static_cast<std::size_t>(w)].holds(2 * pi * k / 1000);
    CHECK(held == 1);
  }
  // 10 d wide, thinner than 4 d over 11.5 degrees: all axis zone.
  Scene narrow = sector.scene;
  for (WallDescription& wall : narrow.walls)
    for (Eigen::Vector2d& point : wall.profile) point.x() *= 0.1;
  CHECK(make_parts(describe_domain(narrow, make_domain(narrow).symmetry, d), {}).front().regions.size() == 2);
}

TEST_CASE("Discharge: rate of a steady stream, of wedges, its interval, arches, and Beverloo's law") {
  const MeasuredDomain run = vessel();
  const std::vector<Part> parts = make_parts(run, {{4}, 4});
  std::vector<Crossing> stream;
  for (int k = 0; k < 2400; ++k) stream.push_back({1 + (k + 0.5) / 2400, std::fmod(2.4 * k, 2 * pi), 1});
  const Estimate rate = discharge_rate(stream, parts[0], 1, 2);
  CHECK(rate.value == Approx(2400));
  CHECK(rate.high - rate.low < 30);
  CHECK(discharge_rate(stream, parts[2], 1, 2).value == Approx(2400).epsilon(0.02));  // a quarter of it, times four
  CHECK(discharge_rate(stream, parts[0], 1.5, 2).value == Approx(2400).epsilon(1e-3));
  CHECK(!arched(stream, parts[0], 1, 2));
  CHECK(arched(stream, parts[0], 1, 2.3));
  // Grains that come in bursts of 100: sqrt(blocks) says what the interval is.
  std::vector<Crossing> bursts;
  for (int k = 0; k < 16; ++k)
    for (int g = 0; g < (k % 2 == 0 ? 100 : 200); ++g) bursts.push_back({(k + 0.5) / 16, 0, 1});
  const Estimate uneven = discharge_rate(bursts, parts[0], 0, 1);
  CHECK(uneven.value == Approx(2400));
  CHECK(uneven.high - uneven.low == Approx(2 * 1.96 * 50 * 4).epsilon(0.1));  // 16 blocks, deviation 50 each
  MeasuredDomain open = run;
  open.scene.stages = {Stage{}};
  open.scene.stages[0].remove = {"plug"};
  CHECK(orifice_diameter(open.scene) == Approx(8 * d));
  CHECK(orifice_diameter(run.scene) == 0);
  const Estimate expected = beverloo_rate(open, 0.6);
  // 0.55 0.6 sqrt(9.81) (6.5 d)^2.5 over pi/6 d^3, and 0.64 with 6.6 d.
  CHECK(expected.low == Approx(0.55 * 0.6 * std::sqrt(9.81) * std::pow(6.5, 2.5) * 6 / pi / std::sqrt(d)));
  CHECK(expected.high == Approx(0.64 * 0.6 * std::sqrt(9.81) * std::pow(6.6, 2.5) * 6 / pi / std::sqrt(d)));
  CHECK(std::isnan(beverloo_rate(run, 0.6).low));
}

TEST_CASE("Zones by speed against that of a plug as wide as the vessel") {
  CHECK(zone_of(0.55, 0, -0.05, 1) == Zone::stagnant);
  CHECK(zone_of(0.55, 0.01, -0.9, 1) == Zone::plug);
  CHECK(zone_of(0.55, -0.3, -0.9, 1) == Zone::converging);  // moves inwards
  CHECK(zone_of(0.55, 0, -3, 1) == Zone::converging);
  CHECK(zone_of(0.55, 0, -0.3, 1) == Zone::converging);
  CHECK(zone_of(0.2, 0, -0.9, 1) == Zone::none);
  CHECK(zone_of(0.55, 0, -0.9, 0) == Zone::none);
}

TEST_CASE("Pictures: a sector's slice lies in its middle, with images at the axis, and a cut is a layer") {
  const MeasuredDomain run = vessel(4);
  const double c = std::cos(pi / 4);
  const std::vector<Grain> grains = {{R, {10 * c * d, 10 * c * d, 5 * d}, {}, {}},  // in the middle
                                     {R, {10 * d, 0.3 * d, 5 * d}, {}, {}},         // near a face
                                     {R, {1.5 * d, 0.1 * d, 9 * d}, {}, {}}};       // near the axis: images too
  const Bed bed = bed_of(run, grains);
  const SlicePicture slice = slice_picture(run, bed);
  REQUIRE(slice.grains.size() ==
          3);                    // the middle one, and two copies of the one near the axis on the half plane's side
  double farthest = 0, off = 1;  // the one in the middle of the sector: 10 d along the plane, not off it
  for (const PictureGrain& g : slice.grains) {
    CHECK(g.position.x >= 0);
    CHECK(std::abs(g.position.y) <= 2 * d);
    if (g.position.x > farthest) farthest = g.position.x, off = g.position.y;
  }
  CHECK(farthest == Approx(10 * d));
  CHECK(off == Approx(0).margin(1e-12));
  CHECK(cut_picture(run, bed, 5.5 * d).size() == 2);
  CHECK(cut_picture(run, bed, 9 * d).size() == 1);
}
