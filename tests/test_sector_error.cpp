// test_sector_error.cpp: what the study expects of a sector: how it scales, for which scenes it is told, and when
// it warns.
#include <cmath>

#include "apps/sector_error.hpp"
#include "io/atomic_file.hpp"
#include "io/csv.hpp"
#include "io/scene_file.hpp"
#include "tests/catch.hpp"
#include "tests/laboratory.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

Scene hopper(const std::vector<std::string>& overrides) {
  return read_scene(std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/hopper.toml", overrides);
}

}  // namespace

TEST_CASE(
    "Expected errors fall with the square of the angle and of the vessel, arches with the arc at the orifice") {
  const SectorExpectation wide = expected_errors(pi / 2, 20, 8), thin = expected_errors(pi / 4, 20, 8),
                          large = expected_errors(pi / 4, 40, 8);
  REQUIRE(wide.errors.size() == thin.errors.size());
  for (std::size_t k = 0; k < wide.errors.size(); ++k) {
    CHECK(thin.errors[k].error == Approx(4 * wide.errors[k].error));
    CHECK(thin.errors[k].uncertainty > 0);
    const bool rate = thin.errors[k].quantity.find("rate") != std::string::npos;
    CHECK(large.errors[k].error == Approx((rate ? 4 : 1) * wide.errors[k].error));  // the orifice is as wide
  }
  CHECK(thin.errors.front().quantity == "packing fraction");
  CHECK(thin.errors.front().error > 0);  // the core is too dense
  CHECK(!thin.thin_at_orifice);
  const SectorExpectation thinnest = expected_errors(pi / 12, 20, 8);  // an arc of 1.05 d at the rim
  CHECK(thinnest.thin_at_orifice);
  CHECK(thinnest.errors.size() + 1 == thin.errors.size());
  CHECK(*thin.arched_share > *wide.arched_share);
  CHECK(*thin.arched_share == *large.arched_share);
  CHECK(!expected_errors(pi / 4, 20, 0).arched_share);  // a sandpile has no orifice
}

TEST_CASE("Expected errors are those of the runs that are kept in apps/study") {
  const auto mean = [](const std::string& ensemble, const std::string& row) {
    double sum = 0;
    for (int seed = 1; seed <= 8; ++seed) {
      const std::string text = read_text_file(std::string(WEDGE_SOURCE_DIR) + "/apps/study/runs/hopper20/" +
                                              ensemble + "_s" + std::to_string(seed) + "/results/scalars.csv");
      const std::size_t at = text.find("\n" + row + ",");
      REQUIRE(at != std::string::npos);
      double value = 0;
      const auto fields = split_csv_line(std::string_view(text).substr(at + 1, text.find('\n', at + 1) - at - 1));
      REQUIRE(parse_number(fields[4].text, value) == NumberError::none);
      sum += value / 8;
    }
    return sum;
  };
  for (const auto& [angle, order] : {std::pair{"a90", 4}, {"a60", 6}, {"a45", 8}, {"a30", 12}}) {
    const SectorExpectation expected = expected_errors(2 * pi / order, 20, 8);
    const auto measured = [&](const char* row) { return mean(angle, row) / mean("a360", row) - 1; };
    CHECK(expected.errors[0].error == Approx(measured("settle,whole,packing")).margin(0.004));
    CHECK(expected.errors[1].error == Approx(measured("settle,whole,cn_distinct")).margin(0.006));
    CHECK(*expected.arched_share == Approx(mean(angle, "flow_mean,whole,arched")).margin(0.3));
  }
}

TEST_CASE("wedge check expects errors of sectors with periodic sides and the axis clamp, and of nothing else") {
  for (const char* other : {"domain.angle=360", "domain.axis=images", "domain.sides=rigid"})
    CHECK(!expected_errors(hopper({"domain.angle=90", other})));
  const auto expected = expected_errors(hopper({"domain.angle=45"}));
  REQUIRE(expected);
  CHECK(expected->errors.front().error ==
        Approx(expected_errors(pi / 4, 40, 8).errors.front().error).epsilon(1e-9));
  CHECK(*expected->arched_share == Approx(*expected_errors(pi / 4, 40, 8).arched_share).epsilon(1e-9));
  CHECK_THAT(expectation_text(*expected),
             Catch::Contains("packing fraction +") && Catch::Contains("an arch stops"));
  CHECK(!expectation_warning(hopper({"domain.angle=180"})));
  const auto warning = expectation_warning(hopper({"domain.angle=15"}));
  REQUIRE(warning);
  CHECK_THAT(*warning, Catch::StartsWith("15 degrees here: "));
}
