// test_fill.cpp: the sizes and materials that a random fill draws have the distribution asked for.
#include "kernels/fill.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

constexpr std::int64_t count = 6000;

/// The grains of a thin fill of a cylinder, in a scene of two materials.
Particles filled(RandomFill fill) {
  Scene s = plain_scene(1e7, 0.3, 3800);
  s.materials.push_back({"light", 1000, 1e7, 0.3});
  fill.count = count;
  fill.r_high = 0.15;
  fill.z_high = 0.3;
  State state = make_state(s, {});
  fill_at_random(state, s, fill);
  Particles& p = state.particles;
  REQUIRE(p.count() == count);
  for (std::size_t i = 0; i < count; ++i)
    CHECK(p.mass[i] == Approx((p.material[i] == 0 ? 3800 : 1000) * pi / 6 * std::pow(2 * p.radius[i], 3)));
  return p;
}

/// Checks mean and standard deviation of f(diameter) over the grains, within four standard errors.
template <class Function>
void check_moments(const Particles& p, const Function& f, double mean, double deviation) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = f(2 * p.radius[i]) - mean;
    sum += x / count;
    squares += x * x / count;
  }
  CHECK(std::fabs(sum) < 4 * deviation / std::sqrt(count));
  CHECK(std::sqrt(squares - sum * sum) == Approx(deviation).margin(4 * deviation / std::sqrt(2.0 * count)));
}

}  // namespace

TEST_CASE("sizes in classes: each has its fraction by number, its diameter and its material", "[fill]") {
  RandomFill fill;
  const std::vector<SizeClass> classes{{0.004, 2, 0}, {0.006, 5, 1}, {0.005, 3, 0}};  // fractions need not add to 1
  fill.sizes = classes;
  const Particles p = filled(fill);
  std::int64_t all = 0;
  for (const SizeClass& c : classes) {
    std::int64_t found = 0;
    for (std::size_t i = 0; i < count; ++i) found += p.radius[i] == 0.5 * c.diameter && p.material[i] == c.material;
    all += found;
    const double part = c.fraction / 10;
    CHECK(static_cast<double>(found) / count == Approx(part).margin(4 * std::sqrt(part * (1 - part) / count)));
  }
  CHECK(all == count);
}

TEST_CASE("uniform sizes: mean (a + b) / 2 and standard deviation (b - a) / sqrt(12) of the diameter", "[fill]") {
  RandomFill fill;
  fill.sizes = UniformSizes{0.004, 0.007, 1};
  const Particles p = filled(fill);
  check_moments(
      p, [](double x) { return x; }, 0.0055, 0.003 / std::sqrt(12.0));
  for (std::size_t i = 0; i < count; ++i) {
    CHECK(p.radius[i] >= 0.002);
    CHECK(p.radius[i] <= 0.0035);
    CHECK(p.material[i] == 1);
  }
}

TEST_CASE("lognormal sizes: ln(diameter) is a normal number between the cuts", "[fill]") {
  // Truncated normal with cuts a and b in standard deviations, Z = Phi(b) - Phi(a): mean mu + sigma (phi(a) -
  // phi(b)) / Z, variance sigma^2 [1 + (a phi(a) - b phi(b)) / Z - ((phi(a) - phi(b)) / Z)^2].
  for (const LognormalSizes& sizes :
       {LognormalSizes{0.005, 0.2, 0.001, 0.02, 0}, LognormalSizes{0.005, 0.3, 0.0045, 0.008, 1}}) {
    RandomFill fill;
    fill.sizes = sizes;
    const Particles p = filled(fill);
    const double a = std::log(sizes.smallest / sizes.median) / sizes.sigma,
                 b = std::log(sizes.largest / sizes.median) / sizes.sigma;
    const auto phi = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2 * pi); };
    const double Z = 0.5 * (std::erfc(-b / std::sqrt(2.0)) - std::erfc(-a / std::sqrt(2.0)));
    const double shift = (phi(a) - phi(b)) / Z, variance = 1 + (a * phi(a) - b * phi(b)) / Z - shift * shift;
    check_moments(
        p, [](double x) { return std::log(x); }, std::log(sizes.median) + sizes.sigma * shift,
        sizes.sigma * std::sqrt(variance));
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(2 * p.radius[i] >= sizes.smallest);
      CHECK(2 * p.radius[i] <= sizes.largest);
      CHECK(p.material[i] == sizes.material);
    }
  }
}

TEST_CASE("a slot is filled over its whole width, left and right of the middle", "[fill]") {
  Scene s = plain_scene(1e7, 0.3, 3800);
  s.domain.kind = DomainKind::slot;
  s.domain.slot_width = 0.02;
  RandomFill fill;
  fill.sizes = std::vector<SizeClass>{{0.005, 1, 0}};
  fill.count = 2000;
  fill.r_low = -0.05;
  fill.r_high = 0.15;
  fill.z_high = 0.5;
  State state = make_state(s, {});
  fill_at_random(state, s, fill);
  REQUIRE(state.particles.count() == 2000);
  double sum = 0, lowest = 1, highest = -1;
  for (std::size_t i = 0; i < 2000; ++i) {
    const Vec3 x = state.particles.position.get(i);
    sum += x.x / 2000;
    lowest = std::min(lowest, x.x);
    highest = std::max(highest, x.x);
    CHECK((x.y >= 0 && x.y < 0.02));
  }
  CHECK(lowest >= -0.0475);
  CHECK(lowest < -0.047);
  CHECK(highest <= 0.1475);
  CHECK(sum == Approx(0.05).margin(4 * 0.195 / std::sqrt(12 * 2000.0)));
}
