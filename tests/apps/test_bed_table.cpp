// test_bed_table.cpp: the table of beds, there and back.
#include <cmath>
#include <limits>

#include "apps/results/bed_table.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;

TEST_CASE("A table of beds reads back as it was written") {
  const ScratchFolder folder;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<StageResult> stages = {
      {"settle", {{"time", "s", 1.0 / 3}, {"grains", "", 8000}, {"load on \"a, b\"", "N", -0.0}}},
      {"open, then wait", {{"time", "s", 2e-9}, {"grains", "", 0}, {"load on \"a, b\"", "N", nan}}}};
  write_bed_table(folder / "beds.csv", stages);
  const std::vector<StageResult> back = read_bed_table(folder / "beds.csv");
  REQUIRE(back.size() == 2);
  for (std::size_t s = 0; s < 2; ++s) {
    CHECK(back[s].stage == stages[s].stage);
    REQUIRE(back[s].quantities.size() == 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const BedQuantity &a = back[s].quantities[k], &b = stages[s].quantities[k];
      CHECK(a.name == b.name);
      CHECK(a.unit == b.unit);
      CHECK((a.value == b.value || (std::isnan(a.value) && std::isnan(b.value))));
    }
  }
}

TEST_CASE("A table of beds that is none is refused with its place") {
  const ScratchFolder folder;
  CHECK_THROWS_AS(read_bed_table(folder / "none.csv"), FileError);
  for (const char* text : {"", "time [s]\n1\n", "stage,time [s]\na,1,2\n", "stage,time [s]\na,soon\n"}) {
    write_text_file_atomically(folder / "beds.csv", text);
    CHECK_THROWS_AS(read_bed_table(folder / "beds.csv"), FileError);
  }
}
