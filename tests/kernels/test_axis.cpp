// test_axis.cpp: the axis rules pin, line, hollow and clamp on one or two grains. (images: test_sector.cpp)
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"
#include "tests/support/impact.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double d = 0.005, R = 0.5 * d;

Scene sector_of(int n, AxisRule axis, double friction = 0, double damping = 0) {
  Scene s = plain_scene(1e7, 0.3, 3800, friction, damping);
  make_sector(s, n, axis);
  return s;
}

}  // namespace

TEST_CASE("pin: within 0.05 R of the axis a grain stays there, beyond it flies by", "[axis]") {
  const Scene s = sector_of(6, AxisRule::pin);
  Experiment held(s, {{R, {0.045 * R, 0.01 * R, 0}, {1, 0.5, 0.3}, {}}}, 1e-5);
  held.run(100);
  CHECK(held.x(0).x == 0.045 * R);
  CHECK(held.x(0).y == 0.01 * R);
  CHECK(held.v(0).z == 0.3);
  CHECK(held.state.energy.axis == Approx(0.5 * held.mass(0) * 1.25));
  CHECK(std::fabs(held.residual()) < 1e-12 * held.begin.kinetic);
  Experiment free(s, {{R, {0.06 * R, 0.01 * R, 0}, {1, 0.1, 0.3}, {}}}, 1e-5);
  free.run(100);
  CHECK(free.x(0).x == Approx(0.06 * R + 1e-3));
  CHECK(free.state.energy.axis == 0);
}

TEST_CASE("pin: a grain on the axis meets all copies of its neighbour, as in the full vessel", "[axis]") {
  for (const int n : {2, 3, 4, 5}) {
    for (const bool swap : {false, true}) {  // the pinned grain with the smaller and with the larger id
      CAPTURE(n, swap);
      const Scene sector = sector_of(n, AxisRule::pin, 0.6, 0.2);
      Scene full = sector;
      full.domain.kind = DomainKind::full;
      full.domain.order = 1;
      const double phi = 0.4 * 2 * pi / n, height = 0.3 * R,
                   across = std::sqrt(4 * R * R - height * height) * 0.998;
      const Vec3 outward{std::cos(phi), std::sin(phi), 0};
      std::vector<Grain> grains{
          {R, {0, 0, 0}, {0, 0, 0.2}, {0, 0, 7}},
          {R, across * outward + Vec3{0, 0, height}, -0.05 * outward + Vec3{0, 0, -0.1}, {3, -8, 20}}};
      const Symmetry symmetry = Symmetry::rotation(n);
      std::vector<Grain> all{grains[0]};
      for (int k = 0; k < n; ++k)
        all.push_back({R, symmetry.turn_point(grains[1].x, k), symmetry.turn_vector(grains[1].v, k),
                       symmetry.turn_vector(grains[1].w, k)});
      const int on_axis = swap ? 1 : 0, beside = 1 - on_axis;
      if (swap) std::swap(grains[0], grains[1]);
      Experiment slice(sector, grains, 2e-6), whole(full, all, 2e-6);
      const double w_before = slice.w(on_axis).z;
      slice.run(400);
      whole.run(400);
      CHECK(norm(slice.x(on_axis) - whole.x(0)) < 1e-12 * d);
      CHECK(norm(slice.v(on_axis) - whole.v(0)) < 1e-11);
      CHECK(norm(slice.w(on_axis) - whole.w(0)) < 1e-8);
      const std::size_t b = slice.slot(beside);
      const int turns = slice.state.particles.turns[b];
      CHECK(norm(symmetry.turn_point(slice.x(beside), turns) - whole.x(1)) < 1e-12 * d);
      CHECK(std::fabs(slice.w(on_axis).z - w_before) > 1);  // they did meet
    }
  }
}

TEST_CASE("pin: a grain that arrives at the axis is stopped there and meets all copies from then on", "[axis]") {
  // It lands on the axis in its first step, far within the margin of the list, and its neighbour comes later.
  for (const int n : {2, 3, 4, 5}) {
    for (const bool swap : {false, true}) {
      CAPTURE(n, swap);
      Scene sector = sector_of(n, AxisRule::pin, 0.6, 0.2);
      sector.run.skin = 0.2 * d;
      Scene full = sector;
      full.domain.kind = DomainKind::full;
      full.domain.order = 1;
      const double phi = 0.4 * 2 * pi / n, dt = 2e-6;
      const Vec3 outward{std::cos(phi), std::sin(phi), 0}, inward = -0.5 * outward + Vec3{0, 0, -0.1}, w{3, -8, 20};
      const Vec3 place = (2 * R + 0.07 * R) * outward + Vec3{0, 0, 0.1 * R};
      std::vector<Grain> grains{{R, 0.06 * R * outward, (-0.06 * R / dt) * outward + Vec3{0, 0, 0.2}, {0, 0, 7}},
                                {R, place, inward, w}};
      const Symmetry symmetry = Symmetry::rotation(n);
      std::vector<Grain> all{{R, {0, 0, 0}, {0, 0, 0.2}, {0, 0, 7}}};
      for (int k = 0; k < n; ++k)
        all.push_back(
            {R, symmetry.turn_point(place, k), symmetry.turn_vector(inward, k), symmetry.turn_vector(w, k)});
      const int on_axis = swap ? 1 : 0, beside = 1 - on_axis;
      if (swap) std::swap(grains[0], grains[1]);
      Experiment slice(sector, grains, dt), whole(full, all, dt);
      slice.run(1);
      whole.run(1);
      CHECK(norm(slice.x(on_axis) - Vec3{0, 0, 0.2 * dt}) < 1e-12 * d);
      CHECK(norm(slice.v(on_axis) - Vec3{0, 0, 0.2}) == 0);
      CHECK(slice.touching() == 0);
      slice.run(249);
      whole.run(249);
      CHECK(slice.touching() == n);
      CHECK(norm(slice.x(on_axis) - whole.x(0)) < 1e-12 * d);
      CHECK(norm(slice.v(on_axis) - whole.v(0)) < 1e-11);
      CHECK(norm(slice.w(on_axis) - whole.w(0)) < 1e-8);
      const int turns = slice.state.particles.turns[slice.slot(beside)];
      CHECK(norm(symmetry.turn_point(slice.x(beside), turns) - whole.x(1)) < 1e-12 * d);
    }
  }
}

TEST_CASE("line: a grain rebounds from the axis as from a rigid plane of its own stiffness", "[axis]") {
  const Scene s = sector_of(8, AxisRule::line);
  const double speed = 0.1, phi = 0.3 * 2 * pi / 8;
  const Vec3 outward{std::cos(phi), std::sin(phi), 0};
  Experiment e(s, {{R, (R + 0.02 * d) * outward, -speed * outward, {}}}, 1e-6);
  double nearest = 1;
  e.run_until(
      [&] {
        nearest = std::min(nearest, std::hypot(e.x(0).x, e.x(0).y));
        return std::hypot(e.x(0).x, e.x(0).y) > R + 0.02 * d;
      },
      100000);
  const double young = 1e7 / (2 * (1 - 0.09));
  const double overlap =
      std::pow(15 * e.mass(0) * speed * speed / (16 * young * std::sqrt(R)), 2.0 / 5.0);  // Hertz
  CHECK(nearest == Approx(R - overlap).margin(1e-4 * overlap));
  CHECK(dot(e.v(0), outward) == Approx(speed).epsilon(1e-4));
  CHECK(std::fabs(e.residual()) < 1e-4 * e.begin.kinetic);
}

TEST_CASE("line: its friction turns a grain that slides along the axis", "[axis]") {
  const Scene s = sector_of(8, AxisRule::line, 0.3, 0.05);
  const double phi = 0.5 * 2 * pi / 8, vn = 0.1, vt = 1.0;
  const Vec3 outward{std::cos(phi), std::sin(phi), 0};
  Experiment e(s, {{R, (R + 1e-9) * outward, -vn * outward + Vec3{0, 0, vt}, {}}}, 1e-6);
  e.run_until([&] { return std::hypot(e.x(0).x, e.x(0).y) > R + 1e-6; }, 100000);
  const double rebound = dot(e.v(0), outward);
  // Gross sliding: the tangential impulse is mu times the (elastic) normal one.
  CHECK(e.v(0).z == Approx(vt - 0.3 * (vn + rebound)).epsilon(5e-3));
  CHECK(norm(e.w(0)) == Approx(2.5 * 0.3 * (vn + rebound) / R).epsilon(3e-2));
}

TEST_CASE("hollow: a grain rebounds from the inner cylinder as from a plane of its own stiffness", "[axis]") {
  Scene s = sector_of(8, AxisRule::hollow);
  s.domain.inner_radius = 4 * d;
  const double speed = 0.1, phi = 0.3 * 2 * pi / 8, start = s.domain.inner_radius + R + 0.02 * d;
  const Vec3 outward{std::cos(phi), std::sin(phi), 0};
  for (const DomainKind kind : {DomainKind::sector, DomainKind::full}) {
    s.domain.kind = kind;
    s.domain.order = kind == DomainKind::full ? 1 : 8;
    Experiment e(s, {{R, start * outward, -speed * outward, {}}}, 1e-6);
    double nearest = 1;
    const bool back = e.run_until(
        [&] {
          nearest = std::min(nearest, norm(e.x(0)));
          return norm(e.x(0)) > start;
        },
        100000);
    REQUIRE(back);
    const HertzImpact hertz{1e7 / (2 * (1 - 0.09)), R, e.mass(0), speed};
    CHECK(nearest == Approx(s.domain.inner_radius + R - hertz.overlap()).margin(1e-4 * hertz.overlap()));
    CHECK(norm(e.v(0) - speed * outward) < 1e-4 * speed);
    CHECK(std::fabs(e.residual()) < 1e-4 * e.begin.kinetic);
  }
}

TEST_CASE("hollow: gross sliding on the inner cylinder has the impulse of a rigid body", "[axis]") {
  // As on a plate (test_impact.cpp): v_t' = v_t - mu (1 + e) v_n and |w| = (5/2) mu (1 + e) v_n / R, obliquely to
  // the axis; the cylinder is so wide that the grain does not come round it within the impact.
  for (const double restitution : {1.0, 0.5}) {
    CAPTURE(restitution);
    Scene s = sector_of(8, AxisRule::hollow);
    s.materials[0].young = 1e9;
    s.domain.inner_radius = 1000 * d;
    s.interactions(0, 0).restitution = restitution;
    s.interactions(0, 0).sliding = 0.1;
    const double phi = 0.3 * 2 * pi / 8, vn = 0.7, vt = 0.8;
    const Vec3 outward{std::cos(phi), std::sin(phi), 0}, along = 0.6 * cross({0, 0, 1}, outward) + Vec3{0, 0, 0.8};
    const double start = s.domain.inner_radius + R * (1 + 1e-9);
    Experiment e(s, {{R, start * outward, -vn * outward + vt * along, {}}}, 5e-8);
    e.run(2);
    REQUIRE(e.touching_walls() == 1);
    REQUIRE(e.run_until([&] { return e.touching_walls() == 0; }, 100000));
    const double impulse = 0.1 * (1 + restitution) * vn;
    CHECK(norm(e.v(0) - (restitution * vn * outward + (vt - impulse) * along)) < 1e-3 * vn);
    CHECK(norm(e.w(0) - (2.5 * impulse / R) * cross(outward, along)) < 1.2e-2 * norm(e.w(0)));
  }
}
