// test_restitution.cpp: damping and restitution against the equation of motion itself, and back.
#include "core/restitution.hpp"

#include "tests/support/catch.hpp"

using namespace wedge;

namespace {

/// Restitution by integrating x'' = -x^p - 2 c sqrt(p) x^((p - 1) / 2) x' from x = 0, x' = 1 (Heun, small steps).
double integrated(double power, Tension tension, double c) {
  const auto force = [&](double x, double v) {
    const double f = std::pow(x, power) + 2 * c * std::sqrt(power) * std::pow(x, 0.5 * (power - 1)) * v;
    return tension == Tension::none ? std::max(0.0, f) : f;
  };
  const double dt = 2e-5;
  double x = 0, v = 1;
  for (int step = 0; step < 4000000; ++step) {
    const double a = -force(x, v), x_next = x + dt * v + 0.5 * dt * dt * a;
    if (x_next <= 0) break;
    v += 0.5 * dt * (a - force(x_next, v + dt * a));
    x = x_next;
  }
  return -v;
}

}  // namespace

TEST_CASE("restitution follows from damping as the equation of motion says", "[restitution]") {
  for (const Tension tension : {Tension::full, Tension::none}) {
    for (const double c : {0.0, 0.05, 0.3, 0.7}) {
      CAPTURE(c);
      CHECK(restitution_of(ContactLaw::mindlin_deresiewicz, tension, c) ==
            Approx(integrated(1.5, tension, c)).margin(2e-4));
      CHECK(restitution_of(ContactLaw::linear, tension, c) == Approx(integrated(1, tension, c)).margin(2e-4));
    }
  }
  for (const double c : {1 / std::sqrt(1.2), 1.3})
    CHECK(restitution_of(ContactLaw::hertz_mindlin, Tension::none, c) ==
          Approx(integrated(1.5, Tension::none, c)).margin(2e-4));
  CHECK(restitution_of(ContactLaw::linear, Tension::full, 1.2) == 0);
}

TEST_CASE("restitution of the default law is the closed table's", "[restitution]") {
  struct Row {
    double damping, pulls, clipped;
  };
  for (const Row& row : {Row{0.05, 0.8417, 0.8468}, Row{0.1, 0.7074, 0.7247}, Row{0.2, 0.4939, 0.5454},
                         Row{0.3, 0.3352, 0.4231}, Row{0.5, 0.1279, 0.2732}}) {
    CHECK(restitution_of(ContactLaw::mindlin_deresiewicz, Tension::full, row.damping) ==
          Approx(row.pulls).margin(1e-4));
    CHECK(restitution_of(ContactLaw::mindlin_deresiewicz, Tension::none, row.damping) ==
          Approx(row.clipped).margin(1e-4));
  }
}

TEST_CASE("damping that is asked to give a restitution gives it", "[restitution]") {
  for (const ContactLaw law : {ContactLaw::mindlin_deresiewicz, ContactLaw::hertz_mindlin, ContactLaw::linear})
    for (const Tension tension : {Tension::full, Tension::none})
      for (const double e : {1e-3, 0.1, 0.5, 0.99, 1.0})
        CHECK(restitution_of(law, tension, damping_for(law, tension, e)) == Approx(e).epsilon(1e-9));
}
