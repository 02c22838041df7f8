// test_angles.cpp: sectors whose angle is no round number of degrees (n = 7, 13, 16) go through analyse, compare
// and report with nothing lost.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "apps/commands/commands.hpp"
#include "apps/results/vocabulary.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"
#include "tests/support/real_program.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

const std::vector<int> orders = {7, 13, 16};

/// Analysed runs of a wide hopper, whose axis zones end inside it: the full vessel, and a sector of each order.
struct Hoppers {
  Hoppers() {
    run(folder / "full", 360);
    AnalyseArguments full;
    full.folder = folder / "full";
    full.orders = orders;
    full.wedges = 4;
    full.threads = 2;
    REQUIRE(command_analyse(full) == exit_code::ok);
    for (const int n : orders) {
      run(sector(n), 360.0 / n);
      AnalyseArguments part;
      part.folder = sector(n);
      part.threads = 2;
      REQUIRE(command_analyse(part) == exit_code::ok);
    }
  }
  std::string sector(int n) const { return folder / ("sector_n" + std::to_string(n)); }

  ScratchFolder folder;

private:
  static void run(const std::string& place, double angle) {
    REQUIRE(command_run(
                arguments_for(place, 2,
                              {"domain.angle=" + number_text(angle), "wall.shell.profile=[[0.06, 0], [0.06, 0.3]]",
                               "wall.floor.profile=[[0.02, 0], [0.06, 0]]", "particles.count=4000",
                               "particles.region={r = [0, 0.06], z = [0, 0.12]}", "stage.settle.until=0.06",
                               "stage.discharge.until=0.04", "output.frames=0.02"})) == exit_code::ok);
  }
};

/// Lines of a table that begin so.
std::size_t rows(const std::string& path, const std::string& beginning) {
  std::ifstream file(path);
  std::size_t found = 0;
  for (std::string line; std::getline(file, line);) found += line.rfind(beginning, 0) == 0 ? 1 : 0;
  return found;
}

/// The row of a comparison that begins so, field by field; empty: there is none.
std::vector<CsvField> row_of(const std::string& path, const std::string& beginning) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.rfind(beginning, 0) == 0) return split_csv_line(line);
  return {};
}

bool has_matplotlib() {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (std::system((std::string(python) + " -B -c 'import numpy, matplotlib' >/dev/null 2>&1").c_str()) == 0)
      return true;
  return false;
}

}  // namespace

TEST_CASE("n = 7, 13, 16: regions, wedges, scalars and distributions come through analyse, compare and report") {
  const Hoppers hoppers;
  const std::string full = hoppers.folder / "full";
  std::vector<std::string> report = {"report", full};
  std::vector<std::string> comparisons;
  for (const int n : orders) {
    INFO("n = " << n);
    const std::string zone = name_of(RegionId{RegionKind::axis_zone, n}),
                      rest = name_of(RegionId{RegionKind::rest, n}), wedge = name_of(PartId{n, 3}),
                      sector = hoppers.sector(n);
    CHECK(rows(full + "/results/distributions.csv", "discharge_mean,whole," + zone + ",cn,") == 1);
    CHECK(rows(full + "/results/distributions.csv", "discharge_mean,whole," + rest + ",cn,") == 1);
    CHECK(rows(full + "/results/scalars.csv", "discharge_mean," + wedge + ",axis_zone_cn,") == 1);
    CHECK(rows(full + "/results/radial.csv", "discharge_mean," + wedge + ",") > 5);
    CHECK(rows(sector + "/results/distributions.csv", "discharge_mean,whole," + zone + ",cn,") == 1);
    CHECK(rows(sector + "/results/scalars.csv", "discharge_mean,whole,axis_zone_cn,") == 1);

    comparisons.push_back(hoppers.folder / ("hopper_a" + angle_text(n) + ".csv"));
    CompareOptions options;
    options.csv = comparisons.back();
    options.moment = "discharge_mean";
    REQUIRE(command_compare({full}, {sector}, options) == exit_code::ok);
    for (const char* key : {"scalar,discharge_mean,all,axis_zone_cn,", "distribution,discharge_mean,axis_zone,cn,",
                            "distribution,discharge_mean,rest,vz,", "profile,discharge_mean,axis_zone,cn,",
                            "map,discharge_mean,rest,packing,"}) {
      INFO(key);
      const std::vector<CsvField> row = row_of(options.csv, key);
      REQUIRE(row.size() == 19);
      CHECK(row[8].text != "nan");   // value
      CHECK(row[12].text != "nan");  // yardstick: the wedges were found
    }
    report.push_back(sector);
  }
  if (!has_matplotlib()) {
    WARN("skipped: no python3 with numpy and matplotlib");
    return;
  }
  for (const std::string& file : comparisons) report.insert(report.end(), {"--compare", file});
  const std::string page_file = hoppers.folder / "page.html";
  report.insert(report.end(), {"-o", page_file});
  const Ended ended = wedge_program(report).wait();
  INFO(ended.errors);
  REQUIRE(ended.code == 0);
  const std::string page = read_text_file(page_file);
  const auto count = [&](const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = page.find(what); at != std::string::npos; at = page.find(what, at + 1)) ++found;
    return found;
  };
  for (const int n : orders) {
    INFO("n = " << n);
    CHECK(count(">" + angle_label(n) + "<br>") >= 3);  // heads of tables: at a glance, numbers, errors
    CHECK(page.find("Slice 4 d thick, " + angle_label(n)) != std::string::npos);
  }
  CHECK(page.find(" in 1 vessel.") != std::string::npos);  // though means of grains of two sizes differ a little
  CHECK(page.find("Distribution of the coordination number in the axis zone") != std::string::npos);
  CHECK(page.find("<code>axis_zone_cn</code>") != std::string::npos);
  CHECK(page.find("region axis zone") != std::string::npos);
  // A number that the vocabulary names is drawn and defined without being told of again.
  const std::string drawn = page.substr(page.rfind("alt=\"All numbers against the angle"), 2000);
  for (const char* name : {"packing", "axis_zone_cn", "discharge_rate", "zone_plug"})
    CHECK(drawn.find(name) != std::string::npos);
  for (const ResultQuantity& q : quantities())
    CHECK(page.find(std::string("<td><code>") + q.name + "</code></td>") != std::string::npos);
}
