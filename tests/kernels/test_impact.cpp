// test_impact.cpp: one impact against closed forms and published numbers.
#include "tests/support/impact.hpp"

#include "tests/support/curve.hpp"
#include "tests/support/known_answer.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// A material of Chung & Ooi (2011) and what the paper prints for its impact.
struct Printed {
  const char* name;
  double young, poisson, density, force, overlap, duration;
};

void compare(const std::string& place, const Printed& row, const char* source, const Impact& r, double speed) {
  const std::string subject = std::string("elastic impact, ") + row.name;
  CHECK(KnownAnswer(place + "1", subject + ": largest force", source, Measure::relative, "N")
            .add(r.force_max, row.force)
            .within(2e-4));
  CHECK(KnownAnswer(place + "2", subject + ": largest overlap", source, Measure::relative, "um")
            .add(r.overlap_max * 1e6, row.overlap * 1e6)
            .within(2e-4));
  CHECK(KnownAnswer(place + "3", subject + ": duration", source, Measure::relative, "us")
            .add(r.duration * 1e6, row.duration * 1e6)
            .within(2e-3));
  CHECK(KnownAnswer(place + "4", subject + ": rebound speed", "energy", Measure::relative, "m/s")
            .add(norm(r.v), speed)
            .within(1e-5));
}

/// The force as a function of time against a digitised curve in microseconds and kilonewtons.
void compare_history(const std::string& place, const char* name, const char* source, const Impact& r,
                     const char* file) {
  std::vector<CurvePoint> ours{{0, 0}};
  for (std::size_t k = 0; k < r.time.size(); ++k) ours.push_back({r.time[k] * 1e6, r.force[k] * 1e-3});
  ours.push_back({ours.back().x + 1e-3, 0});
  ours.push_back({1e6, 0});
  KnownAnswer answer(place, std::string("elastic impact, ") + name + ": force in time", source,
                     Measure::full_scale);
  for (const CurvePoint p : reference_curve(file)) answer.add(interpolate(ours, p.x), p.y);
  CHECK(answer.within(0.01));
}

}  // namespace

TEST_CASE("elastic Hertz impact of two spheres: Chung & Ooi (2011), test 1", "[impact]") {
  const char* source = "Chung & Ooi (2011), test 1";
  const Printed rows[] = {{"glass", 4.8e10, 0.20, 2800, 10697, 274.11e-6, 40.34e-6},
                          {"limestone", 2e10, 0.25, 2500, 7108.2, 368.30e-6, 54.20e-6}};
  for (const Printed& row : rows) {
    const Impact r = head_on(plain_scene(row.young, row.poisson, row.density), 0.01, 10, row.duration / 2000);
    compare(std::string("01") + row.name, row, source, r, 10);
    if (&row == rows) compare_history("01glass5", row.name, source, r, "chung_ooi_1_force.dat");
  }
}

TEST_CASE("elastic Hertz impact on a rigid plane: Chung & Ooi (2011), test 2", "[impact]") {
  const char* source = "Chung & Ooi (2011), test 2";
  const Printed rows[] = {{"aluminium alloy", 7e10, 0.30, 2699, 11370, 49.717e-6, 731.6e-6},
                          {"magnesium alloy", 4e10, 0.35, 1800, 7232.7, 52.123e-6, 767.0e-6}};
  for (const Printed& row : rows) {
    const Scene scene = with_rigid_plate(plain_scene(row.young, row.poisson, row.density));
    const Impact r = on_plate(scene, 0.1, {0, 0, -0.2}, {}, row.duration / 2000);
    compare(std::string("02") + row.name, row, source, r, 0.2);
    if (&row == rows) compare_history("02aluminium alloy5", row.name, source, r, "chung_ooi_2_force.dat");
  }
}

TEST_CASE("restitution of the default law depends on c_n alone", "[impact]") {
  struct Row {
    double damping, pulls, clipped;
  };  // the oscillator of each law, integrated
  const char* source = "separate integration of the normal law";
  KnownAnswer pulls("03a", "restitution for c_n 0.05 ... 0.5, two speeds", source, Measure::absolute);
  KnownAnswer clipped("03b", "restitution with `tension = \"none\"`", source, Measure::absolute);
  for (const Row& row : {Row{0.05, 0.8417, 0.8468}, Row{0.1, 0.7074, 0.7247}, Row{0.2, 0.4939, 0.5454},
                         Row{0.3, 0.3352, 0.4231}, Row{0.5, 0.1279, 0.2732}}) {
    for (const double speed : {0.1, 1.0}) {
      Scene scene = plain_scene(1e7, 0.3, 3800, 0, row.damping);
      const double dt = 2e-7;
      pulls.add(-head_on(scene, 0.0025, speed, dt).v.x / speed, row.pulls);
      scene.contact.tension = Tension::none;
      clipped.add(-head_on(scene, 0.0025, speed, dt).v.x / speed, row.clipped);
    }
  }
  CHECK(pulls.within(2e-4));
  CHECK(clipped.within(2e-4));
}

TEST_CASE("every law gives the prescribed restitution, with and without tension", "[impact]") {
  KnownAnswer answer("03c", "prescribed restitution, 0.4 and 0.8, all laws, with and without tension", "definition",
                     Measure::absolute);
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    for (const Tension tension : {Tension::full, Tension::none}) {
      for (const double e : {0.4, 0.8}) {
        Scene scene = plain_scene(1e7, 0.3, 3800);
        scene.contact.law = law;
        scene.contact.tension = tension;
        scene.contact.normal_stiffness = 1e4;
        scene.interactions(0, 0).restitution = e;
        answer.add(-head_on(scene, 0.0025, 0.3, 1e-7).v.x / 0.3, e);
      }
    }
  }
  CHECK(answer.within(1e-3));
}

TEST_CASE("the linear law lasts the prescribed contact time", "[impact]") {
  Scene scene = plain_scene(1e7, 0.3, 3800);
  scene.contact.law = ContactLaw::linear;
  scene.contact.contact_time = 1e-3;
  scene.interactions(0, 0).restitution = 0.7;
  CHECK(KnownAnswer("03d", "`linear`: prescribed contact time", "definition", Measure::relative, "s")
            .add(head_on(scene, 0.0025, 0.3, 1e-7).duration, 1e-3)
            .within(1e-3));
}

TEST_CASE("oblique impact with gross sliding", "[impact]") {
  // e_t = 1 - mu (1 + e) / tan(phi), |w| = (5/2) mu (1 + e) v_n / R; phi is the angle from the normal. It holds
  // with losses too: over a whole contact the viscous part of the normal force has no impulse.
  const double mu = 0.1, R = 0.0025, v = 1.0;
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    const bool standard = law == ContactLaw::mindlin_deresiewicz, linear = law == ContactLaw::linear;
    const std::string name = standard ? "`mindlin_deresiewicz`" : linear ? "`linear`" : "`hertz_mindlin`";
    for (const double e : {1.0, 0.5}) {
      const std::string place = text("04%.1f", 1 - e) + name,
                        losses = e < 1 ? ", restitution 0.5, " : ", elastic, ";
      KnownAnswer speed(place + "1", "gross sliding" + losses + name + ": tangential restitution",
                        "rigid-body impulse");
      KnownAnswer spin(place + "2", "gross sliding" + losses + name + ": spin", "rigid-body impulse",
                       Measure::relative, "1/s");
      for (const double degrees : {45.0, 60.0, 75.0}) {
        const double phi = degrees * pi / 180;
        Scene scene = plain_scene(1e9, 0.3, 3800, mu);
        scene.contact.law = law;
        scene.contact.normal_stiffness = 1e6;
        scene.interactions(0, 0).restitution = e;
        add_wall(scene, "plate", {{0, 0}, {2, 0}});
        const Vec3 before{0.6 * v * std::sin(phi), 0.8 * v * std::sin(phi), -v * std::cos(phi)};
        const Impact r = on_plate(scene, R, before, {}, 2e-8);
        speed.add((0.6 * r.v.x + 0.8 * r.v.y) / (v * std::sin(phi)), 1 - mu * (1 + e) / std::tan(phi));
        spin.add(norm(r.w), 2.5 * mu * (1 + e) * v * std::cos(phi) / R);
        CHECK(std::fabs(r.w.z) < 1e-9 * norm(r.w));
      }
      CHECK(speed.within(1e-4));
      CHECK(spin.within(1.2e-2));  // lever arm R - dn, not R
    }
  }
}
