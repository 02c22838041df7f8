// test_sector_error.cpp: what the study expects of a sector: how it scales, for which scenes it is told, and when
// it warns.
#include <cmath>
#include <sstream>

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

TEST_CASE("Expected errors fall with powers of the angle and of the vessel, arches with the arc at the orifice") {
  const SectorExpectation wide = expected_errors(pi / 2, 20, 8), thin = expected_errors(pi / 4, 20, 8),
                          large = expected_errors(pi / 4, 40, 8);
  REQUIRE(wide.errors.size() == thin.errors.size());
  for (std::size_t k = 0; k < wide.errors.size(); ++k) {
    const bool rate = thin.errors[k].quantity.find("rate") != std::string::npos;
    CHECK(thin.errors[k].error == Approx((rate ? 16 : 4) * wide.errors[k].error));
    CHECK(thin.errors[k].uncertainty > 0);
    CHECK(large.errors[k].error == Approx((rate ? 16 : 1) * wide.errors[k].error));  // the orifice is as wide
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
  // What the share changes by when its middle is moved by 0.1, as when the sector grows by as much.
  const double theta = pi / 4, step = 1e-4;
  const double slope = (*expected_errors(theta + step, 20, 8).arched_share - *thin.arched_share) / (step * 3);
  CHECK(thin.arched_uncertainty == Approx(-0.1 * slope).epsilon(1e-2));
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

TEST_CASE("Expected errors are those of the tables in apps/study/README.md") {
  const std::string text = read_text_file(std::string(WEDGE_SOURCE_DIR) + "/apps/study/README.md");
  // The factor and its error of a rule, from a row such as "| core | 3.99 ± 0.1 | 1.2 |" below a heading.
  const auto factor = [&](const std::string& heading, const std::string& rule) {
    const std::size_t section = text.find("### " + heading), row = text.find("| " + rule + " | ", section);
    REQUIRE(section != std::string::npos);
    REQUIRE(row < text.find("### ", section + 1));
    std::istringstream words(text.substr(row + rule.size() + 5));
    std::pair<double, double> found;
    std::string plus_minus;
    REQUIRE(words >> found.first >> plus_minus >> found.second);
    return found;
  };
  const double theta = 0.7;
  const auto agree = [](const ExpectedError& expected, std::pair<double, double> table, double share) {
    CHECK(expected.error == Approx(table.first * share).margin(0.2 * table.second * share));
    CHECK(expected.uncertainty == Approx(table.second * share).epsilon(0.5));
  };
  const auto hopper = expected_errors(theta, 30, 10).errors, pile = expected_errors(theta, 30, 0).errors;
  REQUIRE(hopper.size() == 3);
  REQUIRE(pile.size() == 3);
  agree(hopper[0], factor("packing fraction at rest", "core"), std::pow(30 * theta, -2));
  agree(hopper[1], factor("CN of distinct neighbours at rest", "core"), std::pow(30 * theta, -2));
  agree(hopper[2], factor("discharge rate", "flow4"), std::pow(10 * theta, -4));
  const std::size_t repose = text.find("error = a / theta: a = ");
  REQUIRE(repose != std::string::npos);
  std::istringstream words(text.substr(repose + 23));
  std::pair<double, double> angle;
  std::string plus_minus;
  REQUIRE(words >> angle.first >> plus_minus >> angle.second);
  agree(pile[2], angle, 1 / theta);
  // Half of the sectors arch where x is the middle.
  const std::size_t arches = text.find("x = theta (D0 / d - ");
  REQUIRE(arches != std::string::npos);
  std::istringstream line(text.substr(arches + 20));
  double rim = 0, middle = 0, middle_error = 0;
  REQUIRE(line >> rim >> plus_minus >> plus_minus >> middle >> plus_minus >> middle_error);
  const SectorExpectation half = expected_errors(middle / (10 - rim), 30, 10);
  CHECK(*half.arched_share == Approx(0.5).margin(0.02));
  CHECK(half.arched_uncertainty > 0.02);
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
