// test_analysis.cpp: every quantity of wedge analyse on beds with known answers.
#include <cmath>
#include <limits>

#include "apps/analysis/moment_sums.hpp"
#include "apps/analysis/pictures.hpp"
#include "apps/analysis/results.hpp"
#include "apps/flank.hpp"
#include "core/time_scales.hpp"
#include "tests/catch.hpp"
#include "tests/laboratory.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double R = 0.0025, d = 2 * R;
const double mass = sphere_mass(R, 3800);

/// A vessel 40 d wide: the full one, or a sector of it.
AnalysedRun vessel(int order = 1, AxisRule axis = AxisRule::clamp) {
  Scene scene = hopper_material();
  scene.domain.gravity = {0, 0, -9.81};
  add_wall(scene, "shell", {{20 * d, 0}, {20 * d, 60 * d}});
  add_wall(scene, "floor", {{4 * d, 0}, {20 * d, 0}});
  add_wall(scene, "plug", {{0, 0}, {4 * d, 0}});
  if (order > 1) make_sector(scene, order, axis);
  return describe_run(RunFolder("nowhere"), scene, d);
}

ParticleFrame frame_of(const AnalysedRun& run, const std::vector<Grain>& grains) {
  ParticleFrame frame;
  frame.particles = make_state(run.scene, grains).particles;
  return frame;
}

/// As read from a frame without contacts: contacts are overlaps.
BedFrame bed_of(const AnalysedRun& run, const std::vector<Grain>& grains) {
  return make_bed_frame(run, Vessel(run.scene), frame_of(run, grains), nullptr);
}

/// A contact as a frame lists it; `way` leads from the first grain to the second.
struct Touch {
  int first, second, turn;
  double load;  // N
};

BedFrame bed_of(const AnalysedRun& run, const std::vector<Grain>& grains, const std::vector<Touch>& touches) {
  ContactFrame contacts;
  contacts.first_position.resize(touches.size());
  contacts.second_position.resize(touches.size());
  contacts.normal_force.resize(touches.size());
  contacts.tangential_force.resize(touches.size());
  for (std::size_t c = 0; c < touches.size(); ++c) {
    const Touch& t = touches[c];
    contacts.first_id.push_back(t.first);
    contacts.second_id.push_back(t.second);
    contacts.turn.push_back(t.turn);
    contacts.normal_load.push_back(t.load);
    const Vec3 from = grains[static_cast<std::size_t>(t.first)].x;
    const Vec3 to = run.symmetry.turn_point(grains[static_cast<std::size_t>(t.second)].x, t.turn);
    contacts.first_position.set(c, from);
    contacts.second_position.set(c, to);
    contacts.normal_force.set(c, (-t.load / norm(to - from)) * (to - from));
    contacts.tangential_force.set(c, {0, 0, 0});
  }
  return make_bed_frame(run, Vessel(run.scene), frame_of(run, grains), &contacts);
}

std::vector<Grain> lattice(int nx, int ny, int nz, double spacing) {
  std::vector<Grain> grains;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i)
        grains.push_back(
            {R, {(i - 0.5 * (nx - 1)) * spacing, (j - 0.5 * (ny - 1)) * spacing, (k + 2) * spacing}, {}, {}});
  return grains;
}

/// Cells d wide and high over the whole vessel and a margin outside it.
FieldGrid wide_grid(const AnalysedRun& run) {
  FieldGrid grid;
  grid.left = run.left;
  grid.low = -10 * d;
  grid.width = d;
  grid.height = d;
  grid.columns = 30;
  grid.rows = 80;
  grid.smoothing = d;
  return grid;
}

PartSums sums_of(const AnalysedRun& run, const BedFrame& bed, const Part& part) {
  PartSums sums(run, part, wide_grid(run), mass);
  sums.add(bed);
  return sums;
}
PartSums sums_of(const AnalysedRun& run, const BedFrame& bed) {
  return sums_of(run, bed, make_parts(run, {}).front());
}

double number(const PartSums& sums, const std::string& name) {
  for (const Scalar& s : sums.scalars())
    if (s.name == name) return s.estimate.value;
  FAIL("no number " << name);
  return 0;
}

std::size_t kind(const PartSums& sums, const std::string& name) {
  for (std::size_t k = 0; k < sums.kinds().size(); ++k)
    if (sums.kinds()[k].name == name) return k;
  FAIL("no distribution " << name);
  return 0;
}

/// Counts of whole numbers: by value.
double count_of(const PartSums& sums, const std::string& name, int value) {
  const auto& counts = sums.histogram(0, kind(sums, name)).counts();
  const auto found = counts.find(value);
  return found == counts.end() ? 0 : found->second;
}

}  // namespace

TEST_CASE(
    "A simple cubic lattice has six neighbours inside, five, four and three at its faces, edges and corners") {
  const AnalysedRun run = vessel();
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
  const AnalysedRun run = vessel();
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
  const AnalysedRun run = vessel(4);  // 90 degrees
  // Near the faces phi = 0 and 90 degrees, 8 d from the axis: neighbours through the seam.
  const std::vector<Grain> seam = {{R, {8 * d, 0.49 * d, 5 * d}, {}, {}}, {R, {0.49 * d, 8 * d, 5 * d}, {}, {}}};
  const BedFrame pair = bed_of(run, seam);
  CHECK(pair.contacts.size() == 1);
  for (const BedGrain& g : pair.grains) {
    CHECK(g.cn == 1);
    CHECK(g.cn_near == 1);
    CHECK(g.cn_distinct == 1);
  }
  // Two grains 1.2 R from the axis, at 22.5 and 67.5 degrees: one way they are 0.92 R apart ... so set them at
  // different heights, such that both the direct contact and those through the seam hold.
  const double r = 0.9 * R, rise = 1.5 * R, a = pi / 8;
  const std::vector<Grain> core = {{R, {r * std::cos(a), r * std::sin(a), 5 * d}, {}, {}},
                                   {R, {r * std::sin(a), r * std::cos(a), 5 * d + rise}, {}, {}}};
  const BedFrame both = bed_of(run, core);
  CHECK(both.contacts.size() == 2);  // directly, and through one face
  for (const BedGrain& g : both.grains) {
    CHECK(g.cn == 2);
    CHECK(g.cn_distinct == 1);
  }
}

TEST_CASE("A contact with one's own copy half a turn away counts once, with another copy twice") {
  const AnalysedRun half = vessel(2, AxisRule::images);
  CHECK(bed_of(half, {{R, {0, 0.99 * R, 5 * d}, {}, {}}}).grains[0].cn == 1);
  const AnalysedRun third = vessel(3, AxisRule::images);
  const double r = 0.99 * R / std::sin(pi / 3);  // three copies touch one another
  CHECK(bed_of(third, {{R, {r * 0.5, r * std::sqrt(0.75), 5 * d}, {}, {}}}).grains[0].cn == 2);
}

TEST_CASE("Velocities of a bed that turns, spreads and sinks are found by grain, ring, cell and bin") {
  const AnalysedRun run = vessel();
  const double turn = 3, spread = 0.7, sink = 0.02;  // 1/s, 1/s, m/s
  std::vector<Grain> grains = lattice(24, 24, 20, 1.2 * d);
  for (Grain& g : grains) g.v = {-turn * g.x.y + spread * g.x.x, turn * g.x.x + spread * g.x.y, -sink};
  const BedFrame bed = bed_of(run, grains);
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
  const AnalysedRun run = vessel();
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
  double kept = 0;
  for (int row = 0; row < sums.grid().rows; ++row)
    for (int column = 0; column < sums.grid().columns; ++column)
      kept += cell_fields(sums, column, row).packing * sums.grid().volume(column);
  CHECK(kept == Approx(volume).epsilon(2e-3));  // cut at four standard deviations
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
  const AnalysedRun run = vessel();
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
  const AnalysedRun sector = vessel(order), full = vessel();
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
  CHECK(a.rings()[13].grains * order == b.rings()[13].grains);
}

TEST_CASE("Three spheres in a ring: forces, loads and the pressure tensor of a known network") {
  const AnalysedRun run = vessel();
  // Centres at 8 d from the axis in the plane y = 0, a triangle (x, z): (8, 20), (9, 20), (8.5, 20 + sqrt(3)/2) d.
  const double top = std::sqrt(0.75);
  const std::vector<Grain> grains = {
      {R, {8 * d, 0, 20 * d}, {}, {}}, {R, {9 * d, 0, 20 * d}, {}, {}}, {R, {8.5 * d, 0, (20 + top) * d}, {}, {}}};
  const BedFrame bed = bed_of(run, grains, {{0, 1, 0, 2.0}, {0, 2, 0, 3.0}, {1, 2, 0, 5.0}});
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
  double rr = 0, tt = 0, zz = 0, rz = 0;
  for (int row = 0; row < sums.grid().rows; ++row) {
    for (int column = 0; column < sums.grid().columns; ++column) {
      const CellFields c = cell_fields(sums, column, row);
      if (!(c.grains > 0)) continue;  // no pressure where nothing reaches
      rr += c.prr * sums.grid().volume(column);
      tt += c.ptt * sums.grid().volume(column);
      zz += c.pzz * sums.grid().volume(column);
      rz += c.prz * sums.grid().volume(column);
    }
  }
  // The integral over space is the sum of load times branch, d long, in its directions (Goldhirsch 2010).
  CHECK(rr == Approx(d * (2 + 3 * 0.25 + 5 * 0.25)).epsilon(2e-3));
  CHECK(zz == Approx(d * (3 + 5) * 0.75).epsilon(2e-3));
  CHECK(rz == Approx(d * (3 - 5) * 0.5 * top).epsilon(2e-3));
  CHECK(tt == Approx(0).margin(1e-9));
  const SlicePicture picture = slice_picture(run, bed);
  CHECK(picture.grains.size() == 3);
  REQUIRE(picture.lines.size() == 3);
  CHECK(picture.lines[2].load == 5);
  CHECK(norm(picture.lines[2].to - picture.lines[2].from) == Approx(d));
}

TEST_CASE("Pressure: a sector with contacts across its seam has that of the full vessel it unfolds to") {
  const AnalysedRun sector = vessel(4, AxisRule::images), full = vessel();
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
  const AnalysedRun run = vessel(4);
  const std::vector<Grain> grains = {{R, {8 * d, 0.5 * d, 5 * d}, {}, {}}, {R, {0.5 * d, 8 * d, 5 * d}, {}, {}}};
  const BedFrame bed = bed_of(run, grains, {{0, 1, -1, 7.0}});  // the second as seen at (8, -0.5) d
  const double across = 8 / std::hypot(8, 0.5);                 // of the unit vector e_t along y
  CHECK(bed.grains[0].normal_force.y == Approx(7 * across));
  CHECK(bed.grains[1].normal_force.y == Approx(-7 * across));
  CHECK(bed.grains[0].normal_force.x == Approx(bed.grains[1].normal_force.x));
}

TEST_CASE("The kinetic part of the pressure is rho times the mean square of the velocity about the mean") {
  const AnalysedRun run = vessel();
  std::vector<Grain> grains = lattice(24, 24, 20, 1.2 * d);
  for (std::size_t i = 0; i < grains.size(); ++i) grains[i].v = {0, 0, 1 + (i % 2 == 0 ? 0.1 : -0.1)};
  const PartSums sums = sums_of(run, bed_of(run, grains, {{0, 1, 0, 0.0}}));
  const CellFields c = cell_fields(sums, 5, 20);
  CHECK(c.pzz == Approx(3800 * c.packing * 0.01).epsilon(1e-3));
  CHECK(c.velocity.z == Approx(1).epsilon(1e-3));
}

TEST_CASE("The angle of a cone is found, with no scatter over azimuth, and of a cone of two slopes with theirs") {
  const AnalysedRun run = vessel();
  const auto cone = [&](double left, double right) {
    BedFrame bed;
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
    if (s.name != "angle_of_repose") continue;
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
  const AnalysedRun run = vessel(4);
  std::vector<Grain> grains;
  for (int k = 0; k <= 100; ++k) {
    const double z = (5 + 0.4 * k) * d;
    grains.push_back({R, {0.5 * d, 0.5 * d, z}, {}, {}});            // r = 0.71 d
    grains.push_back({R, {1.2 * d, 0.8 * d, z + 0.1 * d}, {}, {}});  // r = 1.44 d
    grains.push_back({R, {9 * d, 3 * d, z + 0.2 * d}, {}, {}});
  }
  BedFrame bed;
  for (const Grain& g : grains) {
    BedGrain b;
    b.position = g.x;
    b.r = std::hypot(g.x.x, g.x.y);
    b.azimuth = std::atan2(g.x.y, g.x.x);
    b.radius = R;
    b.mass = mass;
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
  const AnalysedRun run = vessel(8);  // 45 degrees
  BedFrame bed;
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

TEST_CASE("Regions and wedges: core and rest at 4 d over the angle, wedges side by side around the vessel") {
  const AnalysedRun full = vessel(), sector = vessel(4);
  const std::vector<Part> own = make_parts(sector, {{4, 8}, 3});
  REQUIRE(own.size() == 1);  // wedges are cut from full vessels
  REQUIRE(own[0].regions.size() == 3);
  CHECK(own[0].regions[1].name == "core_90");
  CHECK(own[0].regions[1].to == Approx(4 * d / (pi / 2)));
  CHECK(own[0].regions[2].holds(4 * d));
  const std::vector<Part> parts = make_parts(full, {{4, 8, 24}, 4});
  REQUIRE(parts.size() == 1 + 12);
  CHECK(parts[0].regions.size() == 1 + 2 * 3);
  CHECK(parts[5].name == "wedge_45_0");
  CHECK(parts[9].regions.size() == 3);  // 15 degrees: the core ends at 15.3 d of 20
  for (int k = 0; k < 1000; ++k) {      // the four wedges of 90 degrees hold every azimuth once
    int held = 0;
    for (int w = 1; w <= 4; ++w) held += parts[static_cast<std::size_t>(w)].holds(2 * pi * k / 1000);
    CHECK(held == 1);
  }
  // 10 d wide, thinner than 4 d over 11.5 degrees: all core.
  Scene narrow = sector.scene;
  for (WallDescription& wall : narrow.walls)
    for (Eigen::Vector2d& point : wall.profile) point.x() *= 0.1;
  CHECK(make_parts(describe_run(RunFolder("nowhere"), narrow, d), {}).front().regions.size() == 2);
}

TEST_CASE("Discharge: rate of a steady stream, of wedges, its interval, arches, and Beverloo's law") {
  const AnalysedRun run = vessel();
  const std::vector<Part> parts = make_parts(run, {{4}, 4});
  std::vector<Crossing> stream;
  for (int k = 0; k < 2400; ++k) stream.push_back({1 + (k + 0.5) / 2400, std::fmod(2.4 * k, 2 * pi)});
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
    for (int g = 0; g < (k % 2 == 0 ? 100 : 200); ++g) bursts.push_back({(k + 0.5) / 16, 0});
  const Estimate uneven = discharge_rate(bursts, parts[0], 0, 1);
  CHECK(uneven.value == Approx(2400));
  CHECK(uneven.high - uneven.low == Approx(2 * 1.96 * 50 * 4).epsilon(0.1));  // 16 blocks, deviation 50 each
  AnalysedRun open = run;
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
  const AnalysedRun run = vessel(4);
  const double c = std::cos(pi / 4);
  const std::vector<Grain> grains = {{R, {10 * c * d, 10 * c * d, 5 * d}, {}, {}},  // in the middle
                                     {R, {10 * d, 0.3 * d, 5 * d}, {}, {}},         // near a face
                                     {R, {1.5 * d, 0.1 * d, 9 * d}, {}, {}}};       // near the axis: images too
  const BedFrame bed = bed_of(run, grains);
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
