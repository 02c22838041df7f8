// test_convergence.cpp: orders in the time step: impacts, intervals inside a contact, an orbit on a wall, a seam.
#include "tests/support/order_of_convergence.hpp"

#include "tests/support/impact.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr double R = 0.0025, young = 1e7, poisson = 0.3, density = 3800;
constexpr int coarse_steps = 40;  // coarsest steps in the duration of an elastic impact

struct Case {
  ContactLaw law = ContactLaw::mindlin_deresiewicz;
  double sliding = 0, damping = 0;
};

Scene scene_of(const Case& c) {
  Scene s = plain_scene(young, poisson, density, c.sliding, c.damping);
  s.contact.law = c.law;
  s.contact.normal_stiffness = 5e3;  // linear only: about as stiff as the others at 0.5 m/s
  return s;
}

double duration_on_plate(double speed) {
  return HertzImpact{young / (2 * (1 - poisson * poisson)), R, sphere_mass(R, density), speed}.duration();
}

/// Runs for `steps` coarsest steps, cut into 2^level each.
Experiment& run_for(Experiment& e, int steps, int level) {
  e.run(steps << level);
  return e;
}

void append(Outcome& out, Vec3 v, double unit) {
  for (const double c : {v.x, v.y, v.z}) out.push_back(c / unit);
}

/// Positions in units of the way made in the time T at `speed`, velocities of `speed`, spins of speed / R.
Outcome outcome(const Experiment& e, int grains, double speed, double T) {
  Outcome out;
  for (int i = 0; i < grains; ++i) {
    append(out, e.x(i), speed * T);
    append(out, e.v(i), speed);
    append(out, e.w(i), speed / R);
  }
  return out;
}

/// A sphere thrown at a plate of its own material at `degrees` from the normal, spinning; the end is well after
/// the contact.
Solve thrown(const Case& c, double degrees, double speed = 0.5) {
  return [=](int level, double offset) {
    Scene s = scene_of(c);
    add_wall(s, "plate", {{0, 0}, {2, 0}});
    const double T = duration_on_plate(speed), coarse = coarse_step(T, coarse_steps, offset);
    const double tangential = speed * std::tan(degrees * pi / 180);
    Experiment e(
        s, {{R, {0.3, 0.2, R + speed * coarse * (1 + offset)}, {0.6 * tangential, 0.8 * tangential, -speed}, {}}},
        std::ldexp(coarse, -level));
    return outcome(run_for(e, 3 * coarse_steps, level), 1, speed, T);
  };
}

/// Makes a contact one that has lasted: it begins with the displacement given and has the half step of growth that
/// the step before would have left in memory (kernels/README.md, "Stored displacement").
void hold(Experiment& e, Vec3Array& history, Vec3 displacement, Vec3 slip, double dt) {
  history.set(0, displacement);
  e.step.start(e.state, dt);
  history.set(0, history.get(0) + (0.5 * dt) * slip);
}

/// The same, but from the approach until before the sphere parts: nothing begins or ends on the way.
Solve inside_contact(const Case& c, double tangential, bool sliding) {
  return [=](int level, double offset) {
    Scene s = scene_of(c);
    add_wall(s, "plate", {{0, 0}, {2, 0}});
    const double speed = 0.5, T = duration_on_plate(speed),
                 dt = std::ldexp(coarse_step(T, coarse_steps, offset), -level);
    const double overlap =
        0.5 * HertzImpact{young / (2 * (1 - poisson * poisson)), R, sphere_mass(R, density), speed}.overlap();
    const Vec3 slip{0.6 * tangential, 0.8 * tangential, 0};
    Experiment e(s, {{R, {0.3, 0.2, R - overlap}, slip + Vec3{0, 0, -0.6 * speed}, {}}}, dt);
    hold(e, e.state.wall_contacts.history, (sliding ? R / tangential : 0) * slip, slip, dt);
    return outcome(run_for(e, coarse_steps / 2, level), 1, speed, T);
  };
}

const char* law_name(ContactLaw law) {
  return law == ContactLaw::hertz_mindlin ? "`hertz_mindlin`"
         : law == ContactLaw::linear      ? "`linear`"
                                          : "`mindlin_deresiewicz`";
}

}  // namespace

TEST_CASE("elastic impacts converge with the second order", "[convergence]") {
  const double speed = 0.5;
  const double mass = sphere_mass(R, density), modulus = young / (2 * (1 - poisson * poisson));
  {
    const double T = HertzImpact{modulus, R, mass, speed}.duration();
    const Order order = measure_order(thrown({}, 0), coarse_steps, [=](double offset) {
      // free flight to the plate, the contact in closed form, free flight away
      const double coarse = coarse_step(T, coarse_steps, offset);
      const double away = speed * ((3 * coarse_steps - 1 - offset) * coarse - T);
      return Outcome{0.3 / (speed * T), 0.2 / (speed * T), (R + away) / (speed * T), 0, 0, 1, 0, 0, 0};
    });
    CHECK(order_within("1a", "elastic impact on a wall, against the closed form", order, 1.9, 2.2));
  }
  {
    const double T = HertzImpact{modulus, R / 2, mass / 2, 2 * speed}.duration();
    const Order order = measure_order(
        [=](int level, double offset) {
          const double coarse = coarse_step(T, coarse_steps, offset);
          Experiment e(scene_of({}),
                       {{R, {-R - speed * coarse * (1 + offset), 0.1, 0}, {speed, 0, 0}, {}},
                        {R, {R + speed * coarse * (1 + offset), 0.1, 0}, {-speed, 0, 0}, {}}},
                       std::ldexp(coarse, -level));
          return outcome(run_for(e, 3 * coarse_steps, level), 2, speed, T);
        },
        coarse_steps,
        [=](double offset) {
          const double coarse = coarse_step(T, coarse_steps, offset), y = 0.1 / (speed * T);
          const double away = (R + speed * ((3 * coarse_steps - 1 - offset) * coarse - T)) / (speed * T);
          return Outcome{-away, y, 0, -1, 0, 0, 0, 0, 0, away, y, 0, 1, 0, 0, 0, 0, 0};
        });
    CHECK(order_within("1b", "elastic impact of two spheres, against the closed form", order, 1.9, 2.2));
  }
}

TEST_CASE("smooth intervals inside a contact converge with the second order", "[convergence]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear}) {
    const std::string name = law_name(law);
    CHECK(order_within("2a" + name, "inside a contact, damped, sticking, " + name,
                       measure_order(inside_contact({law, 5, 0.3}, 0.1, false), coarse_steps), 1.9, 2.2));
    CHECK(order_within("2b" + name, "inside a contact, damped, sliding, " + name,
                       measure_order(inside_contact({law, 0.1, 0.3}, 2, true), coarse_steps), 1.9, 2.2));
  }
}

TEST_CASE("damped impacts converge with the order their law allows", "[convergence]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin}) {
    const std::string name = law_name(law);
    CHECK(order_within("3a" + name, "damped impact, " + name, measure_order(thrown({law, 0, 0.3}, 0), coarse_steps),
                       1.1, 1.6, "damping grows like overlap^(1/4) at first touch: 5/4"));
  }
  CHECK(order_within("3b", "damped impact, `linear`",
                     measure_order(thrown({ContactLaw::linear, 0, 0.3}, 0), coarse_steps), 0.8, 1.2,
                     "the damping force jumps at first touch: 1"));
}

TEST_CASE("oblique frictional impacts converge with the order their first touch allows", "[convergence]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin}) {
    const std::string name = law_name(law);
    CHECK(order_within("4a" + name, "oblique impact, undamped, sticking (10 degrees, mu 0.6), " + name,
                       measure_order(thrown({law, 0.6, 0}, 10), coarse_steps), 1.8, 2.2));
    CHECK(order_within("4b" + name, "oblique impact, undamped, stick and slip (45 degrees, mu 0.3), " + name,
                       measure_order(thrown({law, 0.3, 0}, 45), coarse_steps), 1.8, 2.2));
    CHECK(order_within("4c" + name, "oblique impact, undamped, sliding (75 degrees, mu 0.1), " + name,
                       measure_order(thrown({law, 0.1, 0}, 75), coarse_steps), 1.8, 2.2));
    CHECK(order_within("4d" + name, "oblique impact, damped (45 degrees, mu 0.6), " + name,
                       measure_order(thrown({law, 0.6, 0.3}, 45), coarse_steps), 1.1, 1.6,
                       "as damped impacts: 5/4"));
  }
}

TEST_CASE("an orbit on a cylinder wall converges with the second order", "[convergence]") {
  // Pressed on by its own motion the sphere circles at a constant overlap: m v^2 / r = (4/3) E* sqrt(R) dn^(3/2),
  // r = R_c - R + dn. T is one turn; a quarter of it is run.
  const double cylinder = 0.02, speed = 1;
  double overlap = 0;
  for (int k = 0; k < 100; ++k)
    overlap = std::pow(sphere_mass(R, density) * speed * speed / (cylinder - R + overlap) /
                           (4.0 / 3.0 * young / (2 * (1 - poisson * poisson)) * std::sqrt(R)),
                       2.0 / 3.0);
  const double r = cylinder - R + overlap, T = 2 * pi * r / speed;
  const int turn_steps = 640;
  for (const bool rolling : {false, true}) {
    const double spin = rolling ? -speed / (R - overlap) : 0;  // the contact point stands still
    const auto at = [=](double angle) {
      const double c = std::cos(angle), s = std::sin(angle);
      return Grain{R, {r * c, r * s, 0.05}, {-speed * s, speed * c, 0}, {0, 0, spin}};
    };
    const Order order = measure_order(
        [=](int level, double offset) {
          Scene s = scene_of({ContactLaw::mindlin_deresiewicz, rolling ? 0.6 : 0, rolling ? 0.3 : 0});
          add_wall(s, "cylinder", {{cylinder, 0}, {cylinder, 0.1}});
          Experiment e(s, {at(offset)}, std::ldexp(coarse_step(T, turn_steps, offset), -level));
          return outcome(run_for(e, turn_steps / 4, level), 1, speed, T);
        },
        turn_steps,
        [=](double offset) {
          const Grain g = at(offset + speed * (turn_steps / 4) * coarse_step(T, turn_steps, offset) / r);
          Outcome out;
          append(out, g.x, speed * T);
          append(out, g.v, speed);
          append(out, g.w, speed / R);
          return out;
        });
    CHECK(order_within(rolling ? "5b" : "5a",
                       std::string("orbit on a cylinder wall, ") + (rolling ? "rolling, damped" : "frictionless"),
                       order, 1.9, 2.2));
  }
}

TEST_CASE("a pair that crosses a seam converges with the second order", "[convergence]") {
  // Two unequal grains in a sliding, damped contact that drift through the face of a sector of 60 degrees.
  const double speed = 0.5, T = duration_on_plate(speed), face = pi / 3, r = 40 * R;
  const auto turned = [](Vec3 v, double a) {
    return Vec3{std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
  };
  bool crossed = true;
  const Order order = measure_order(
      [&](int level, double offset) {
        Scene s = scene_of({ContactLaw::mindlin_deresiewicz, 5, 0.3});
        make_sector(s, 6, AxisRule::images);
        const double start = face - (0.004 + 0.002 * offset);
        const Vec3 first = turned({r, 0, 0.1}, start), along = turned({0.8, 0.6, 0}, start);
        const Vec3 drift = turned({0, 4, 0}, start), push = 0.3 * along;
        const double dt = std::ldexp(coarse_step(T, coarse_steps, offset), -level);
        const Vec3 slip{0, 0, -0.1};
        Experiment e(
            s, {{R, first, drift + push, {}}, {1.3 * R, first + 0.99 * 2.3 * R * along, drift - push - slip, {}}},
            dt);
        hold(e, e.state.contacts.history, {}, slip, dt);
        run_for(e, coarse_steps / 2, level);
        Outcome out;
        for (int i = 0; i < 2; ++i) {
          const int turns = e.state.particles.turns[e.slot(i)];
          append(out, e.state.symmetry.turn_point(e.x(i), turns), speed * T);
          append(out, e.state.symmetry.turn_vector(e.v(i), turns), speed);
          append(out, e.state.symmetry.turn_vector(e.w(i), turns), speed / R);
          crossed = crossed && (turns == 1);
        }
        return out;
      },
      coarse_steps);
  CHECK(crossed);
  CHECK(order_within("6", "pair crossing a seam, damped, sticking", order, 1.9, 2.2));
}
