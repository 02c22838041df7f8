// test_random.cpp: the counter-based generator against the published known answers.
#include "core/random.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

TEST_CASE("Philox4x32-10 gives the known answers of its authors", "[random]") {
  // Random123 distribution, kat_vectors, lines "philox4x32 10".
  using Block = std::array<std::uint32_t, 4>;
  CHECK(philox({0, 0, 0, 0}, {0, 0}) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}) ==
        Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}) ==
        Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("a stream goes on where it stopped and streams differ", "[random]") {
  RandomStream a(7, 1);
  for (int i = 0; i < 5; ++i) a.uniform();
  RandomStream b(7, 1, a.given()), c(7, 2, a.given());
  const double next = a.uniform();
  CHECK(b.uniform() == next);
  CHECK(c.uniform() != next);
  RandomStream d(3, 0);
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double u = d.uniform();
    REQUIRE((u >= 0 && u < 1));
    sum += u;
  }
  CHECK(sum / 10000 == Approx(0.5).margin(4 * 0.2887 / 100));  // four standard errors
}
