// test_impact.cpp: one impact against closed forms and published numbers.
#include "tests/catch.hpp"
#include "tests/laboratory.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

struct Impact {
  double force_max = 0, overlap_max = 0, duration = 0, rebound = 0;
};

/// Two equal spheres head on, each at `speed`; dt is duration / steps_per_contact.
Impact head_on(const Scene& scene, double radius, double speed, double dt) {
  Experiment e(scene,
               {{radius, {-radius, 0.3 * radius, 0}, {speed, 0, 0}, {}},
                {radius, {radius + 1e-9 * radius, 0.3 * radius, 0}, {-speed, 0, 0}, {}}},
               dt);
  Impact r;
  bool touched = false;
  e.run_until(
      [&] {
        const bool now = e.touching() > 0;
        touched = touched || now;
        if (now) {
          r.duration += dt;
          r.overlap_max = std::max(r.overlap_max, e.deepest_overlap());
          r.force_max = std::max(r.force_max, norm(e.state.contacts.force(0)));
        }
        return touched && !now;
      },
      2000000);
  r.rebound = -e.v(0).x;
  return r;
}

/// A sphere falling on the plate z = 0 without gravity.
Impact on_plate(Scene scene, double radius, double speed, double dt) {
  Experiment e(scene, {{radius, {0.3, 0.2, radius * (1 + 1e-9)}, {0, 0, -speed}, {}}}, dt);
  Impact r;
  bool touched = false;
  e.run_until(
      [&] {
        const bool now = e.touching_walls() > 0;
        touched = touched || now;
        if (now) {
          r.duration += dt;
          for (const double o : e.state.wall_contacts.overlap) r.overlap_max = std::max(r.overlap_max, o);
          r.force_max = std::max(r.force_max, norm(e.state.particles.force.get(0)));
        }
        return touched && !now;
      },
      2000000);
  r.rebound = e.v(0).z;
  return r;
}

}  // namespace

TEST_CASE("elastic Hertz impact of two spheres: Chung & Ooi (2011), test 1", "[impact]") {
  struct Row {
    double young, poisson, density, force, overlap, duration;
  };
  for (const Row& row :
       {Row{4.8e10, 0.20, 2800, 10697, 274.11e-6, 40.34e-6}, Row{2e10, 0.25, 2500, 7108.2, 368.30e-6, 54.20e-6}}) {
    const Impact r = head_on(plain_scene(row.young, row.poisson, row.density), 0.01, 10, row.duration / 2000);
    CHECK(r.force_max == Approx(row.force).epsilon(2e-4));
    CHECK(r.overlap_max == Approx(row.overlap).epsilon(2e-4));
    CHECK(r.duration == Approx(row.duration).epsilon(2e-3));
    CHECK(r.rebound == Approx(10).epsilon(1e-5));
  }
}

TEST_CASE("elastic Hertz impact on a rigid plane: Chung & Ooi (2011), test 2", "[impact]") {
  struct Row {
    double young, poisson, density, force, overlap, duration;
  };
  for (const Row& row :
       {Row{7e10, 0.30, 2699, 11370, 49.717e-6, 731.6e-6}, Row{4e10, 0.35, 1800, 7232.7, 52.123e-6, 767.0e-6}}) {
    Scene scene = plain_scene(row.young, row.poisson, row.density);
    scene.materials.push_back({"rigid", 1, 1e30, 0.3});
    scene.interactions = PairTable<Interaction>(2);
    add_wall(scene, "plate", {{0, 0}, {2, 0}}, 1);
    const Impact r = on_plate(scene, 0.1, 0.2, row.duration / 2000);
    CHECK(r.force_max == Approx(row.force).epsilon(2e-4));
    CHECK(r.overlap_max == Approx(row.overlap).epsilon(2e-4));
    CHECK(r.duration == Approx(row.duration).epsilon(2e-3));
    CHECK(r.rebound == Approx(0.2).epsilon(1e-5));
  }
}

TEST_CASE("restitution of the default law depends on c_n alone", "[impact]") {
  struct Row {
    double damping, pulls, clipped;
  };  // PHYSICS section 1
  for (const Row& row : {Row{0.05, 0.8417, 0.8468}, Row{0.1, 0.7074, 0.7247}, Row{0.2, 0.4939, 0.5454},
                         Row{0.3, 0.3352, 0.4231}, Row{0.5, 0.1279, 0.2732}}) {
    for (const double speed : {0.1, 1.0}) {
      Scene scene = plain_scene(1e7, 0.3, 3800, 0, row.damping);
      const double dt = 2e-7;
      CHECK(head_on(scene, 0.0025, speed, dt).rebound / speed == Approx(row.pulls).margin(2e-4));
      scene.contact.tension = Tension::none;
      CHECK(head_on(scene, 0.0025, speed, dt).rebound / speed == Approx(row.clipped).margin(2e-4));
    }
  }
}

TEST_CASE("every law gives the restitution asked for, with and without tension", "[impact]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    for (const Tension tension : {Tension::full, Tension::none}) {
      for (const double e : {0.4, 0.8}) {
        Scene scene = plain_scene(1e7, 0.3, 3800);
        scene.contact.law = law;
        scene.contact.tension = tension;
        scene.contact.normal_stiffness = 1e4;
        scene.interactions(0, 0).restitution = e;
        CHECK(head_on(scene, 0.0025, 0.3, 1e-7).rebound / 0.3 == Approx(e).margin(1e-3));
      }
    }
  }
}

TEST_CASE("the linear law lasts the contact time asked for", "[impact]") {
  Scene scene = plain_scene(1e7, 0.3, 3800);
  scene.contact.law = ContactLaw::linear;
  scene.contact.contact_time = 1e-3;
  scene.interactions(0, 0).restitution = 0.7;
  CHECK(head_on(scene, 0.0025, 0.3, 1e-7).duration == Approx(1e-3).epsilon(1e-3));
}

TEST_CASE("oblique impact with gross sliding", "[impact]") {
  // e_t = 1 - mu (1 + e) / tan(phi), |w| = (5/2) mu (1 + e) v_n / R; phi is the angle from the normal
  const double mu = 0.1, R = 0.0025, v = 1.0;
  for (const double degrees : {45.0, 60.0, 75.0}) {
    const double phi = degrees * pi / 180;
    Scene scene = plain_scene(1e9, 0.3, 3800, mu);
    add_wall(scene, "plate", {{0, 0}, {2, 0}});
    Experiment e(scene,
                 {{R,
                   {0.1, 0.2, R * (1 + 1e-9)},
                   {0.6 * v * std::sin(phi), 0.8 * v * std::sin(phi), -v * std::cos(phi)},
                   {}}},
                 2e-8);
    bool touched = false;
    REQUIRE(e.run_until(
        [&] {
          touched = touched || e.touching_walls();
          return touched && !e.touching_walls();
        },
        1000000));
    const double tangential = 0.6 * e.v(0).x + 0.8 * e.v(0).y;
    CHECK(tangential / (v * std::sin(phi)) == Approx(1 - mu * 2 / std::tan(phi)).epsilon(3e-3));
    CHECK(norm(e.w(0)) == Approx(2.5 * mu * 2 * v * std::cos(phi) / R).epsilon(1.2e-2));  // lever arm R - dn, not R
    CHECK(std::fabs(e.w(0).z) < 1e-9 * norm(e.w(0)));
  }
}
