// test_sector_error.cpp: what the study expects of a sector: how it scales, for which scenes it is told, that it is
// what the study's tables say, and when it warns.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "apps/commands/sector_error.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/experiment.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

Scene scene(const std::string& name, const std::vector<std::string>& overrides) {
  return read_scene(std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/" + name + ".toml", overrides);
}
Scene hopper(const std::vector<std::string>& overrides) { return scene("hopper", overrides); }

struct Measured {
  double value = 0, error = 0;
};

/// The cells of a row of a Markdown table, without blanks around them.
std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream text(row);
  std::string cell;
  std::getline(text, cell, '|');  // what stands before the first
  while (std::getline(text, cell, '|')) {
    const std::size_t begin = cell.find_first_not_of(' ');
    cells.push_back(begin == std::string::npos ? "" : cell.substr(begin, cell.find_last_not_of(' ') - begin + 1));
  }
  return cells;
}

/// The number at the start of the cell in this row and column of the table of errors below a heading.
double number_in_table(const std::string& text, const std::string& heading, const std::string& row,
                       const std::string& column) {
  const auto line = [&](const std::string& start, std::size_t from) {
    const std::size_t begin = text.find("\n| " + start + " |", from);
    INFO(heading << ": " << start);
    REQUIRE(begin != std::string::npos);
    return text.substr(begin + 1, text.find('\n', begin + 1) - begin - 1);
  };
  const std::size_t section = text.find("### " + heading);
  REQUIRE(section != std::string::npos);
  const auto columns = cells_of(line("vessel", section)), cells = cells_of(line(row, section));
  const auto found = std::find(columns.begin(), columns.end(), column);
  REQUIRE(found != columns.end());
  return std::stod(cells.at(static_cast<std::size_t>(found - columns.begin())));
}

/// The numbers of "... = 4.15 ± 0.1 ..." in a text, after these words, from a place on.
Measured number_after(const std::string& text, const std::string& words, std::size_t from = 0) {
  const std::size_t place = text.find(words, from);
  INFO(words);
  REQUIRE(place != std::string::npos);
  std::istringstream numbers(text.substr(place + words.size()));
  Measured found;
  std::string plus_minus;
  REQUIRE(numbers >> found.value >> plus_minus >> found.error);
  return found;
}

}  // namespace

TEST_CASE("Expected errors fall with powers of the angle and of the vessel, stops with the arc at the orifice") {
  const SectorExpectation wide = expected_errors({pi / 2, 20, 8}), thin = expected_errors({pi / 4, 20, 8}),
                          large = expected_errors({pi / 4, 40, 8});
  REQUIRE(wide.errors.size() == 3);
  for (std::size_t k = 0; k < wide.errors.size(); ++k) {
    const bool rate = thin.errors[k].quantity.find("rate") != std::string::npos;
    CHECK(thin.errors[k].error == Approx((rate ? 16 : 4) * wide.errors[k].error));
    CHECK(thin.errors[k].uncertainty > 0);
    CHECK(large.errors[k].error == Approx((rate ? 16 : 1) * wide.errors[k].error));  // the orifice is as wide
  }
  CHECK(thin.errors.front().quantity == "packing fraction");
  CHECK(thin.errors.front().error > 0);  // the axis zone is too dense
  CHECK(!thin.thin_at_orifice);
  CHECK(*thin.stopped_share > *wide.stopped_share);
  CHECK(*thin.stopped_share == *large.stopped_share);
}

TEST_CASE("Nothing is expected of flows where there is none, or where the sector is too thin for one") {
  const SectorExpectation thinnest = expected_errors({pi / 12, 20, 8});  // an arc of 1.05 d at the rim
  CHECK(thinnest.thin_at_orifice);
  CHECK(thinnest.errors.size() == 2);
  CHECK(!thinnest.stopped_share);
  const SectorExpectation closed = expected_errors({pi / 4, 20});
  CHECK(closed.errors.size() == 2);
  CHECK(!closed.thin_at_orifice);
  CHECK(!closed.stopped_share);
}

TEST_CASE("Of a pile its own numbers are told, and only where a pile forms") {
  const Scene pile = scene("sandpile", {"domain.angle=45"});
  const auto expected = expected_errors(pile);
  REQUIRE(expected);
  REQUIRE(expected->errors.size() == 2);
  CHECK(expected->errors[0].quantity.find("angle of repose") == 0);
  CHECK(expected->errors[0].error < -0.1);
  const SectorExpectation thin = expected_errors({pi / 8, 40, 0, 32});
  CHECK(thin.errors[0].error == Approx(2 * expected->errors[0].error));
  CHECK(thin.errors[1].error == Approx(4 * expected->errors[1].error));
  Scene before = pile;  // the bed alone
  for (Stage& stage : before.stages) stage.remove.clear();
  CHECK(expected_errors(before)->errors[0].quantity == "packing fraction");
}

TEST_CASE("Expected errors are those measured in eight runs of each angle") {
  const std::string text = read_text_file(std::string(WEDGE_SOURCE_DIR) + "/apps/study/README.md");
  const std::string vessel = "D 20 d, orifice 8 d (hopper20)";
  for (const auto& [angle, order] : {std::pair{"90°", 4}, {"60°", 6}, {"45°", 8}, {"30°", 12}}) {
    const SectorExpectation expected = expected_errors({2 * pi / order, 20, 8});
    const auto measured = [&, angle = angle](const char* heading) {
      return number_in_table(text, heading, vessel, angle);
    };
    CHECK(expected.errors[0].error == Approx(measured("packing fraction at rest") / 100).margin(0.004));
    CHECK(expected.errors[1].error == Approx(measured("CN of distinct neighbours at rest") / 100).margin(0.006));
    if (expected.stopped_share) CHECK(*expected.stopped_share == Approx(measured("stops: ") / 8).margin(0.3));
  }
}

TEST_CASE("Expected errors are those of the tables in apps/study/README.md") {
  const std::string text = read_text_file(std::string(WEDGE_SOURCE_DIR) + "/apps/study/README.md");
  // The factor of a rule, from a row such as "| axis zone | 3.99 ± 0.1 | 1.2 |" below a heading.
  const auto factor = [&](const std::string& heading, const std::string& rule) {
    const std::size_t section = text.find("### " + heading);
    REQUIRE(section != std::string::npos);
    REQUIRE(text.find("| " + rule + " | ", section) < text.find("### ", section + 1));
    return number_after(text, "| " + rule + " | ", section);
  };
  const double theta = 0.7;
  const auto agree = [](const ExpectedError& expected, Measured table, double share) {
    CHECK(expected.error == Approx(table.value * share).margin(0.2 * table.error * share));
    CHECK(expected.uncertainty == Approx(table.error * share).epsilon(0.3));
  };
  const auto hopper = expected_errors({theta, 30, 10}).errors, pile = expected_errors({theta, 40, 0, 32}).errors;
  REQUIRE(hopper.size() == 3);
  REQUIRE(pile.size() == 2);
  agree(hopper[0], factor("packing fraction at rest", "axis zone"), std::pow(30 * theta, -2));
  agree(hopper[1], factor("CN of distinct neighbours at rest", "axis zone"), std::pow(30 * theta, -2));
  agree(hopper[2], factor("discharge rate", "flow4"), std::pow(10 * theta, -4));
  agree(pile[0], number_after(text, "error = a / theta: a = "), 1 / theta);
  agree(pile[1], number_after(text, "error = a / theta^2: a = "), std::pow(theta, -2));
  // Half of the sectors stop where x is the middle: "x = theta (D0 / d - 4.5) = 3.55 ± 0.1; ..."
  const std::string x = "x = theta (D0 / d - ";
  const std::size_t stops = text.find(x);
  REQUIRE(stops != std::string::npos);
  const double rim = std::stod(text.substr(stops + x.size()));
  const Measured middle = number_after(text, ") = ", stops);
  const SectorExpectation half = expected_errors({middle.value / (10 - rim), 30, 10});
  CHECK(*half.stopped_share == Approx(0.5).margin(0.02));
  // What the share changes by when the middle moves by its error, as when the sector grows by as much.
  const SectorExpectation less = expected_errors({(middle.value + middle.error) / (10 - rim), 30, 10});
  CHECK(half.stopped_uncertainty == Approx(*half.stopped_share - *less.stopped_share).epsilon(0.1));
}

TEST_CASE("wedge check expects errors of sectors with periodic sides and the axis clamp, and of nothing else") {
  for (const char* other : {"domain.angle=360", "domain.axis=images", "domain.sides=rigid"})
    CHECK(!expected_errors(hopper({"domain.angle=90", other})));
  const auto expected = expected_errors(hopper({"domain.angle=60"}));
  REQUIRE(expected);
  const SectorExpectation same = expected_errors({pi / 3, 40, 8});
  CHECK(expected->errors.front().error == Approx(same.errors.front().error).epsilon(1e-9));
  CHECK(*expected->stopped_share == Approx(*same.stopped_share).epsilon(1e-9));
  CHECK_THAT(expectation_text(*expected),
             Catch::Contains("packing fraction +0.") && Catch::Contains("an arch stops or interrupts "));
}

TEST_CASE("wedge check warns of sectors that are too thin for their bed or flow, and of sides that are walls") {
  CHECK(!expectation_warning(hopper({"domain.angle=90"})));
  CHECK(expectation_warning(hopper({"domain.angle=45"})));
  CHECK_THAT(*expectation_warning(hopper({"domain.angle=15"})),
             Catch::StartsWith("15 degrees: ") && Catch::Contains("too thin at the orifice"));
  CHECK_THAT(*expectation_warning(hopper({"domain.angle=90", "domain.sides=rigid"})), Catch::Contains("are walls"));
  CHECK(!expectation_warning(scene("sandpile", {"domain.angle=180"})));
  CHECK(expectation_warning(scene("sandpile", {"domain.angle=30"})));
}

TEST_CASE("An expected error is told with the decimals that its uncertainty has") {
  SectorExpectation one;
  one.errors = {{"a", 0.0123456, 0.0123}, {"b", -0.0123456, 0.0023}, {"c", 0.00123456, 0.00003}};
  CHECK(expectation_text(one) == "a +1 +- 1 %, b -1.2 +- 0.2 %, c +0.12 +- 0.01 %");
}
