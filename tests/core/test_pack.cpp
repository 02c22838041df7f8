// test_pack.cpp: packs of numbers choose lane by lane, and records of eight turn into columns and back.
#include "core/pack.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

namespace {

template <class Number>
PackOf<Number> counted(Number first) {
  return PackOf<Number>([&](auto lane) { return first + static_cast<Number>(static_cast<int>(lane)); });
}

template <class Number>
void check_lanes() {
  using Real = PackOf<Number>;
  const Real a = counted<Number>(1), b = counted<Number>(100);
  for (Index least = 0; least <= lanes<Number>; ++least) {
    const auto condition = a > Real(static_cast<Number>(least));
    const Real chosen = select(condition, a, b);
    CHECK(any_lane(condition) == (least < lanes<Number>));
    for (Index k = 0; k < lanes<Number>; ++k) {
      const auto lane = static_cast<std::size_t>(k);
      const Number x = a[lane], y = b[lane], z = chosen[lane];  // lanes of packs are proxies
      CHECK(z == (x > static_cast<Number>(least) ? x : y));
    }
  }
}

double entry(int row, int column) { return 10.0 * row + column; }

}  // namespace

TEST_CASE("a pack chooses lane by lane", "[pack]") {
  check_lanes<double>();
  check_lanes<float>();
}

TEST_CASE("each lane where a condition holds is visited once, ascending", "[pack]") {
  const Pack a = counted<double>(0);
  std::vector<Index> visited, expected;
  for_each_lane(a > 0.5, [&](Index lane) { visited.push_back(lane); });
  for (Index k = 1; k < pack_size; ++k) expected.push_back(k);
  CHECK(visited == expected);
}

TEST_CASE("eight records become columns, and columns records", "[pack]") {
  Eight rows[8], columns[8], few_columns[4];
  Four short_rows[8], back[8];
  EightFloats float_rows[8], float_columns[8];
  for (int r = 0; r < 8; ++r) {
    for (int c = 0; c < 8; ++c) {
      rows[r][c] = entry(r, c);
      float_rows[r][c] = static_cast<float>(entry(r, c));
      if (c < 4) short_rows[r][c] = entry(r, c);
    }
  }
  transpose(rows, columns);
  transpose(float_rows, float_columns);
  transpose(short_rows, few_columns);
  transpose(few_columns, back);
  for (int r = 0; r < 8; ++r) {
    for (int c = 0; c < 8; ++c) {
      const double in_column = columns[c][r], in_float = static_cast<double>(float_columns[c][r]);
      CHECK(in_column == entry(r, c));
      CHECK(in_float == entry(r, c));
      if (c >= 4) continue;
      const double in_few = few_columns[c][r], again = back[r][c];
      CHECK(in_few == entry(r, c));
      CHECK(again == entry(r, c));
    }
  }
}

TEST_CASE("doubles narrow into packs of floats and widen out of them", "[pack]") {
  constexpr Index n = lanes<float>;
  double in[n], out[n];
  for (Index k = 0; k < n; ++k) in[k] = 1.0 / (3 + k);
  store(out, load<PackOf<float>>(in));
  for (Index k = 0; k < n; ++k) CHECK(out[k] == static_cast<double>(static_cast<float>(in[k])));
}
