// test_vocabulary.cpp: names are made and read by one place, each once, and definitions leave nothing out.
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "apps/results/scalar.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;

TEST_CASE("Every quantity has its own name, a table, a label and a definition") {
  std::set<std::string> names, labels;
  for (const ResultQuantity& q : quantities()) {
    INFO(q.name);
    CHECK(names.insert(q.name).second);
    CHECK(labels.insert(std::string(q.label) + heading(q.name)).second);
    CHECK(q.tables != 0);
    CHECK(std::string(q.label).size() > 0);
    CHECK(std::string(q.definition).back() == '.');
    CHECK(std::string(q.name).find_first_of(" ,[") == std::string::npos);
    CHECK(find_quantity(q.name) == &q);
  }
  CHECK(find_quantity("core_cn") == nullptr);
  CHECK_THROWS_AS(scalar("pakking", 1.0), std::logic_error);
  CHECK(scalar("discharge_rate", 2.0).quantity->unit == std::string("1/s"));
  CHECK(headings({"r", "cn", "vz"}) == ",r [m],cn,vz [m/s]");
}

TEST_CASE("Regions and wedges of every number of sectors are read back from their names") {
  CHECK(name_of(RegionId{RegionKind::axis_zone, 4}) == "axis_zone_n4");
  CHECK(name_of(RegionId{RegionKind::rest, 7}) == "rest_n7");
  CHECK(name_of(RegionId{}) == "all");
  CHECK(name_of(PartId{4, 0}) == "wedge_n4_0");
  CHECK(name_of(PartId{}) == "whole");
  for (int n = 2; n <= 360; ++n) {
    for (const RegionKind kind : {RegionKind::axis_zone, RegionKind::rest}) {
      const auto region = region_of(name_of(RegionId{kind, n}));
      REQUIRE(region.has_value());
      CHECK((region->kind == kind && region->sectors == n));
    }
    const auto part = part_of(name_of(PartId{n, n - 1}));
    REQUIRE(part.has_value());
    CHECK((part->sectors == n && part->number == n - 1 && !part->whole()));
  }
  CHECK(region_of("all")->kind == RegionKind::all);
  CHECK(part_of("whole")->whole());
  for (const char* none :
       {"", "core_90", "axis_zone", "axis_zone_n", "axis_zone_n1", "axis_zone_n04", "rest_n4x", "All"})
    CHECK_FALSE(region_of(none).has_value());
  for (const char* none : {"", "wedge_90_0", "wedge_n4", "wedge_n4_", "wedge_n4_-1", "wedge_n1_0", "wedge_n4_0 "})
    CHECK_FALSE(part_of(none).has_value());
}

TEST_CASE("Angles are told to people short, to the command line exactly, and read back") {
  CHECK(label_of(RegionId{RegionKind::axis_zone, 7}) == "axis zone of 51.4\u00b0");
  CHECK(angle_label(4) == "90\u00b0");
  CHECK(angle_label(16) == "22.5\u00b0");
  CHECK(angle_text(7) == "51.428571");
  CHECK(angle_text(16) == "22.5");
  for (int n = 2; n <= 360; ++n) CHECK(sectors_of(angle_text(n)) == n);
  CHECK(sectors_of("51.428571") == 7);
  CHECK(sectors_of("51.43") == 7);
  CHECK(sectors_of("51.4") == 7);
  CHECK(sectors_of("27.692308") == 13);
  CHECK(sectors_of("51.42857142857143") == 7);
  for (const char* none : {"51", "89.99", "100", "50", "51.5", "360", "0.5", "-90", "ninety", ""}) {
    INFO(none);
    CHECK_FALSE(sectors_of(none).has_value());
  }
}

TEST_CASE("The axis zone of a quarter ends at 4 d over its angle") {
  CHECK(axis_zone_edge(4, 0.002) == Approx(4 * 0.002 / std::acos(0.0)));
}

TEST_CASE("Definitions for people and for the page of a report have every quantity") {
  const std::string text = definitions_text();
  const auto json = nlohmann::json::parse(vocabulary_json());
  CHECK(json.at("axis_zone_arc_d") == axis_zone_arc);
  std::set<std::string> names;
  for (const auto& q : json.at("quantities")) names.insert(q.at("name").get<std::string>());
  CHECK(names.size() == quantities().size());
  for (const ResultQuantity& q : quantities()) {
    INFO(q.name);
    CHECK(text.find("  " + heading(q.name) + " (") != std::string::npos);
    CHECK(names.count(q.name) == 1);
  }
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    CHECK(end - begin <= 120);
    begin = end + 1;
  }
}
