// test_symmetry.cpp: rotations by whole fractions of a turn against exact values and each other.
#include "core/symmetry.hpp"

#include <cmath>

#include "core/random.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

TEST_CASE("turns by multiples of 90 degrees are exact", "[symmetry]") {
  for (int n : {4, 8, 12}) {
    const Symmetry s = Symmetry::rotation(n);
    const Vec3 v = s.turn_vector({0.3, 0.7, 0.1}, n / 4);
    CHECK(v.x == -0.7);
    CHECK(v.y == 0.3);
    CHECK(v.z == 0.1);
  }
}

TEST_CASE("a turn by k is counter-clockwise by k sector angles", "[symmetry]") {
  const Symmetry s = Symmetry::rotation(6);
  const Vec3 v = s.turn_vector({1, 0, 0}, 1);
  CHECK(v.x == Approx(0.5).epsilon(1e-15));
  CHECK(v.y == Approx(std::sqrt(3.0) / 2).epsilon(1e-15));
  CHECK(s.turn_vector({1, 0, 0}, -2).y == Approx(-std::sqrt(3.0) / 2).epsilon(1e-15));
}

TEST_CASE("residues lie above -n/2 and reach up to n/2", "[symmetry]") {
  for (int n : {2, 3, 4, 5, 12}) {
    const Symmetry s = Symmetry::rotation(n);
    for (int k = -3 * n; k <= 3 * n; ++k) {
      const int r = s.residue(k);
      CHECK((2 * r > -n && 2 * r <= n));
      CHECK((k - r) % n == 0);
    }
  }
}

TEST_CASE("every point is turned home into the domain", "[symmetry]") {
  RandomStream random(5, 0);
  for (int n : {2, 3, 4, 5, 6, 8, 12, 120}) {
    const Symmetry s = Symmetry::rotation(n);
    for (int i = 0; i < 400; ++i) {
      const Vec3 p{random.uniform(-1, 1), random.uniform(-1, 1), 0};
      const Vec3 q = s.turn_point(p, s.turns_home(p));
      double phi = std::atan2(q.y, q.x);
      if (phi < -1e-12) phi += 2 * 3.14159265358979323846;
      CHECK(phi <= s.angle() + 1e-12);
      CHECK(std::hypot(q.x, q.y) == Approx(std::hypot(p.x, p.y)).epsilon(1e-15));
    }
    CHECK(s.turns_home({0.7, 0, 0}) == 0);  // the face phi = 0 belongs to the domain
    CHECK(s.turns_home(s.turn_point({0.7, 0.0, 0}, 0)) == 0);
    CHECK(s.turns_home({0.7, -1e-9, 0}) == s.residue(1));
  }
  CHECK(Symmetry::rotation(4).turns_home({0, 0.7, 0}) == -1);  // the face phi = 90 does not
  CHECK(Symmetry::translation(0.5).turns_home({3, 1.2, 0}) == -2);
}

TEST_CASE("distance of a copy to the domain is the smallest over points of the domain", "[symmetry]") {
  RandomStream random(9, 0);
  for (int n : {2, 3, 4, 6, 12}) {
    const Symmetry s = Symmetry::rotation(n);
    for (int i = 0; i < 40; ++i) {
      const double r = random.uniform(0.01, 1), phi = random.uniform(0, s.angle());
      const Vec3 p{r * std::cos(phi), r * std::sin(phi), 0};
      for (int k = 1; k < n; ++k) {
        const Vec3 copy = s.turn_point(p, k);
        double brute = 1e9;  // over both faces, finely sampled
        for (int m = 0; m <= 20000; ++m) {
          const double rho = 1.2 * m / 20000;
          for (double face : {0.0, s.angle()})
            brute = std::fmin(brute, std::hypot(copy.x - rho * std::cos(face), copy.y - rho * std::sin(face)));
        }
        CHECK(s.distance_to_domain(p, k) == Approx(brute).margin(1e-4));
      }
    }
  }
}
