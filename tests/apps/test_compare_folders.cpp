// test_compare_folders.cpp: wedge compare on folders as `wedge analyse` leaves them: complete, incomplete and
// wrong.
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <sstream>
#include <tuple>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/tables/csv.hpp"
#include "tests/support/compare_command.hpp"
#include "tests/support/synthetic_study.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

namespace fs = std::filesystem;

const char* const result_files[] = {"scalars.csv", "distributions.csv", "radial.csv", "map.csv"};

/// Takes wedge number `wedge` out of the results of a run.
void take_wedge_out(const std::string& folder, int wedge) {
  for (const char* file : result_files)
    rewrite(folder + "/results/" + file, "wedge_n4_" + std::to_string(wedge), "wedge_n5_" + std::to_string(wedge));
}

/// The bed of a moment comes to rest: all grains in the two bins of vz beside 0, or one more besides.
void lay_to_rest(const std::string& folder, const std::string& moment, bool one_moves = false) {
  const std::string path = folder + "/results/distributions.csv", middle = ",vz,m/s,1000000,1e-6,";
  std::istringstream text(read_text_file(path));
  std::string line, all;
  while (std::getline(text, line)) {
    if (line.compare(0, moment.size() + 1, moment + ",") == 0)
      line = line.substr(0, line.find(middle)) + middle + (one_moves ? "-2,1 80 120" : "-1,80 120");
    all += line + "\n";
  }
  write_text_file_atomically(path, all);
}

std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST_CASE("Sectors of the same law agree with full vessels, shifted ones do not", "[compare]") {
  Study study;
  const auto full = study.full(6);
  CompareOptions options;
  options.csv = study.path("same.csv");
  const Said same = compare(full, study.sectors(5, 0), options);
  CHECK(same.code == 0);
  CHECK(has(same.text, "axis zone: r < 4 d / theta = 2.55 d"));
  CHECK(has(
      same.text,
      "yardstick: 5 wedges against 6 full vessels, drawn 1000 times from the 24 wedges of the 6 reference runs"));
  CHECK(has(same.text, "bootstrap over seeds"));
  const std::vector<Row> rows = rows_of(options.csv);
  // Of each moment: two scalars; one distribution, by two measures, in three regions; a profile and a map in three.
  REQUIRE(rows.size() == 2 * (2 + 6 + 3 + 3));
  int beyond = 0;
  for (const Row& row : rows) {
    beyond += row.at("beyond") == "1" ? 1 : 0;
    CHECK(row.at("bootstrap") == "seeds");
    CHECK(row.at("reference_runs") == "6");
    CHECK(row.at("compared_runs") == "5");
    CHECK(number(row, "yardstick_low") <= number(row, "yardstick"));
    CHECK(number(row, "yardstick") <= number(row, "yardstick_high"));
    CHECK(number(row, "low") <= number(row, "high"));
  }
  CHECK(beyond <= 4);
  options.csv = study.path("shifted.csv");
  const Said shifted = compare(full, study.sectors(5, 1), options);
  CHECK(has(shifted.text, "28 of 28 rows with a yardstick are beyond"));
  for (const Row& row : rows_of(options.csv)) {
    CHECK(row.at("beyond") == "1");
    if (row.at("measure") == "wasserstein") CHECK(number(row, "value") == Approx(1).margin(0.15));
    if (row.at("measure") == "rms") CHECK(number(row, "value") == Approx(1).margin(0.1));
    if (row.at("quantity") == "cn") CHECK(number(row, "relative") == Approx(0.2).margin(0.02));
  }
}

TEST_CASE("Few runs are compared over wedges, few without wedges by what is left, and it is said", "[compare]") {
  Study study;
  const auto full = study.full(2), sector = study.sectors(1, 0);
  CompareOptions options;
  options.csv = study.path("rows.csv");
  options.moment = "settle";
  const Said few = compare(full, sector, options);
  CHECK(has(few.text, "bootstrap over the wedges of the reference runs"));
  CHECK_FALSE(has(few.text, "moment flow_mean"));
  for (const Row& row : rows_of(options.csv)) CHECK(row.at("bootstrap") == "wedges");

  const Said one = compare({full[0]}, sector, options);
  CHECK(has(one.text, "which knows nothing of other seeds"));

  const Said bare = compare(study.sectors(2, 0), sector, options);  // alike, two runs
  CHECK(has(bare.text,
            "yardstick: 1 run against 2 sectors of 90 degrees, drawn 1000 times from the 2 reference runs"));
  for (const Row& row : rows_of(options.csv)) CHECK(row.at("bootstrap") == "none");

  const Said other = compare(full, study.sectors(1, 0, 45), options);  // nobody cut wedges of 45 degrees
  CHECK(has(other.text,
            "yardstick: not known: the reference runs have no wedges of this angle; cut some: wedge analyse"));
  for (const Row& row : rows_of(options.csv)) CHECK(row.at("beyond") == "nan");
}

TEST_CASE("The same runs compared with themselves do not differ, twice to the same letters", "[compare]") {
  Study study;
  const auto full = study.full(5);
  CompareOptions options;
  options.csv = study.path("rows.csv");
  const Said first = compare(full, full, options);
  for (const Row& row : rows_of(options.csv)) {
    CHECK(number(row, "value") == 0);
    CHECK(row.at("beyond") == "0");
    CHECK(row.at("region") == "all");  // a full vessel has no axis zone
  }
  CHECK(compare(full, full, options).text == first.text);
}

TEST_CASE("Folders that lack files are compared in what they have", "[compare]") {
  Study study;
  const auto full = study.full(2), sector = study.sectors(1, 0);
  fs::remove(sector[0] + "/results/map.csv");
  fs::remove(full[1] + "/results/radial.csv");
  CompareOptions options;
  options.csv = study.path("rows.csv");
  const Said said = compare(full, sector, options);
  CHECK(has(said.text, sector[0] + ": there is no results/map.csv: its quantities are left out for this run"));
  for (const Row& row : rows_of(options.csv)) {
    CHECK(row.at("kind") != "map");
    if (row.at("kind") == "profile") CHECK(row.at("reference_runs") == "1");
  }
  fs::remove(sector[0] + "/results/summary.json");  // which tells d
  const Said unknown = compare(full, sector, options);
  CHECK(has(unknown.text, "summary.json is missing: no axis zone and rest of profiles and maps"));
  for (const Row& row : rows_of(options.csv))
    if (row.at("kind") == "profile") CHECK(row.at("region") == "all");
  fs::remove_all(sector[0] + "/results");
  const Said bare = compare(full, sector);
  CHECK(bare.code == 0);
  CHECK(has(bare.text, sector[0] + ": has not been analysed; run: wedge analyse " + sector[0]));
  options = {};
  options.tolerance = study.file("t.toml", "[[tolerance]]\nrelative = 1\n");
  CHECK_THROWS_AS(compare(full, sector, options), FileError);
}

TEST_CASE("A file of an analysis that is wrong is refused with its place", "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  const std::string distributions = sector[0] + "/results/distributions.csv",
                    scalars = sector[0] + "/results/scalars.csv";
  const std::string head = "moment,part,region,quantity,unit,scale,step,first,counts\n";
  for (const auto& [rows, says] :
       {std::make_pair(head + "settle,whole,all,vz,m/s,1,0,0,1 two\n", ":2: error: 'two' is not a number"),
        std::make_pair(head + "settle,whole,all,vz,m/s,0,0,0,1 2\n", ":2: error: scale must be above 0"),
        std::make_pair(head + "settle,whole,all,vz,m/s,1,0,0,1 -2\n", ":2: error: counts must be at least 0"),
        std::make_pair(head + "settle,whole,all,vz,m/s,1,0,0\n", ":2: error: expected 9 fields"),
        std::make_pair(
            head + "settle,whole,core_90,vz,m/s,1,0,0,1 2\n",
            ":2: error: 'core_90' is not a region that this version of wedge knows; measure the run again"),
        std::make_pair(head + "settle,whole,all,core_cn,,1,0,0,1 2\n", ":2: error: 'core_cn' is not a quantity"),
        std::make_pair(head + "settle,wedge_90_0,all,vz,m/s,1,0,0,1 2\n", ":2: error: 'wedge_90_0' is not a part"),
        std::make_pair(std::string("moment,part,area\n"), ":1: error: there is no column 'region'"),
        std::make_pair(std::string("stage,time\n"), ":1: error: this is not a table of `wedge analyse`"),
        std::make_pair(std::string(), ":1: error: the file is empty")}) {
    write_text_file_atomically(distributions, rows);
    CHECK(has(complaint([&] { compare(full, sector); }), distributions + says));
  }
}

TEST_CASE("Sets of mixed angles and moments that are not there are wrong usage", "[compare]") {
  Study study;
  auto sector = study.sectors(1, 0);
  const auto full = study.full(1), other = study.sectors(1, 0, 60);
  CompareOptions options;
  options.moment = "setle";
  const Said said = compare(full, sector, options);
  CHECK(said.code == 2);
  CHECK(has(said.errors, "did you mean 'settle'?"));
  sector.push_back(other[0]);
  const Said mixed = compare(full, sector);
  CHECK(mixed.code == 2);
  CHECK(has(mixed.errors, "the compared runs have different domains: " + sector[0] + " (90 degrees)"));
  CHECK(mixed.text.empty());
  CHECK(compare(sector, full).code == 2);
}

TEST_CASE("Tolerances: exit 0 within, 6 outside, and never silently about nothing", "[compare]") {
  Study study;
  const auto full = study.full(2), sector = study.sectors(2, 0.5);
  CompareOptions options;
  const auto judged = [&](const std::string& text) {
    options.tolerance = study.file("tolerance.toml", text);
    return compare(full, sector, options);
  };
  const std::string vz =
      "[[tolerance]]\nmoment = \"flow_*\"\nquantity = \"vz\"\nregion = \"all\"\nmeasure = \"wasserstein\"\n";
  const Said within = judged(vz + "relative = 0.5\nabsolute = 1\n");
  CHECK(within.code == 0);
  CHECK(has(within.text, "tolerance.toml: all 1 row within tolerance"));
  const Said outside = judged(vz + "absolute = 0.1\n[[tolerance]]\nkind = \"scalar\"\nabsolute = 10\n");
  CHECK(outside.code == 6);
  CHECK(has(outside.text, "of 5 rows outside of tolerance:\n  distribution flow_mean: vz [m/s], wasserstein"));

  const auto refused = [&](const std::string& text) { return complaint([&] { judged(text); }); };
  CHECK(has(refused("[[tolerance]]\nquantity = \"cm\"\nrelative = 1\n"),
            "tolerance.toml:1:1: error: this tolerance fits no row of the comparison"));
  CHECK(has(refused("[[tolerance]]\nquantity = \"cnn\"\nrelative = 1\n"), "did you mean 'cn'?"));
  CHECK(has(refused("[[tolerance]]\nkind = \"map\"\nmeasure = \"ks\"\nrelative = 1\n"), "no row has all of these"));
  CHECK(has(refused("[[tolerance]]\nquantty = \"cn\"\nrelative = 1\n"), "did you mean 'quantity'?"));
  CHECK(has(refused("[[tolerance]]\nrelative = -1\n"), "'relative' must be at least 0"));
  CHECK(has(refused("[[tolerance]]\nquantity = \"cn\"\n"), "'relative' is missing"));
  CHECK(has(refused("[[tolerances]]\nrelative = 1\n"), "unknown table 'tolerances'"));
  CHECK(has(refused("[tolerance]\nrelative = 1\n"), "must be a list of tables"));
  CHECK(has(refused("relative =\n"), "tolerance.toml:1:"));
  CHECK(has(refused("\n"), "there is no tolerance in this file"));
  CHECK_THROWS_AS(judged("[[tolerance]]\nquantity = \"cm\"\nrelative = 1\n"), SceneError);
}

TEST_CASE("A quantity that is not known is not within tolerance", "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  const std::string head = "moment,part,quantity,unit,value,low,high\nsettle,whole,vr,m/s,";
  write_text_file_atomically(full[0] + "/results/scalars.csv", head + "0,nan,nan\n");
  write_text_file_atomically(sector[0] + "/results/scalars.csv", head + "0.1,nan,nan\n");
  CompareOptions options;
  options.tolerance = study.file("t.toml", "[[tolerance]]\nquantity = \"vr\"\nrelative = 100\n");
  CHECK(compare(full, sector, options).code == 6);
}

TEST_CASE("Scalars that only sectors and wedges have are compared with the wedges of the full vessels",
          "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  std::string text = "moment,part,quantity,unit,value,low,high\n";
  for (int k = 0; k < 4; ++k)
    text += "settle,wedge_n4_" + std::to_string(k) + ",cn_slope,1," + std::to_string(k) + ",nan,nan\n";
  write_text_file_atomically(full[0] + "/results/scalars.csv", text);
  write_text_file_atomically(sector[0] + "/results/scalars.csv",
                             "moment,part,quantity,unit,value,low,high\nsettle,whole,cn_slope,1,5,nan,nan\n");
  CompareOptions options;
  options.csv = study.path("rows.csv");
  compare(full, sector, options);
  const Row row = rows_of(options.csv).at(0);
  CHECK(row.at("quantity") == "cn_slope");
  CHECK(number(row, "reference") == 1.5);
  CHECK(number(row, "value") == 3.5);
}

TEST_CASE("Histograms of different bins are compared in the bins of both", "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  const std::string head = "moment,part,region,quantity,unit,scale,step,first,counts\nsettle,whole,all,vz,m/s,";
  write_text_file_atomically(full[0] + "/results/distributions.csv", head + "1000000,1e-6,0,3 3 5 5\n");
  CompareOptions options;
  options.csv = study.path("rows.csv");
  for (const auto& [counts, wasserstein, ks] :
       {std::make_tuple("0,6 10", 0.0, 0.0), std::make_tuple("1,6 10", 2.0, 0.625)}) {  // bins twice as wide
    write_text_file_atomically(sector[0] + "/results/distributions.csv", head + "2000000,1e-6," + counts + "\n");
    compare(full, sector, options);
    std::map<std::string, double> found;
    for (const Row& row : rows_of(options.csv))
      if (row.at("kind") == "distribution") found[row.at("measure")] = number(row, "value");
    CHECK(found.at("wasserstein") == Approx(wasserstein).margin(1e-6));
    CHECK(found.at("ks") == Approx(ks).margin(1e-6));
  }
}

TEST_CASE("Axis zone and rest of a map are split at 4 d over theta", "[compare]") {
  Study study;
  const auto full = study.full(1), sector = study.sectors(1, 0);
  std::string first = "moment,part,r [m],z [m],grains,cn,zone\n", second = first;
  for (int k = 0; k < 6;
       ++k) {  // r = 0.5 d ... 5.5 d: the axis zone of a quarter ends at 2.55 d; three cells inside
    const std::string place = "settle,whole," + number_text((k + 0.5) * d) + ",0,1,";
    first += place + "5,0\n";
    second += place + (k < 3 ? "7,0\n" : "6,0\n");
  }
  write_text_file_atomically(full[0] + "/results/map.csv", first);
  write_text_file_atomically(sector[0] + "/results/map.csv", second);
  CompareOptions options;
  options.csv = study.path("rows.csv");
  compare(full, sector, options);
  std::map<std::string, double> rms;
  for (const Row& row : rows_of(options.csv))
    if (row.at("kind") == "map") rms[row.at("region")] = number(row, "value");
  REQUIRE(rms.size() == 3);
  CHECK(rms["axis_zone"] == Approx(2));
  CHECK(rms["rest"] == Approx(1));
  CHECK(rms["all"] == Approx(std::sqrt(2.5)));
}

TEST_CASE("Fewer than four wedges are no yardstick, and it is said what gives one", "[compare]") {
  Study study;
  const auto full = study.full(2), sector = study.sectors(1, 0);
  for (const std::string& folder : full)
    for (const int wedge : {2, 3}) take_wedge_out(folder, wedge);
  CompareOptions options;
  options.csv = study.path("rows.csv");
  const Said few = compare({full[0]}, sector, options);
  CHECK(
      has(few.text,
          "yardstick: not known: 2 wedges of this angle are too few, at least 4 of all reference runs are needed; "
          "cut more: wedge analyse REF --angles 90 --wedges 4; or name more reference runs (seeds)\n"));
  for (const Row& row : rows_of(options.csv)) {
    CHECK(row.at("beyond") == "nan");
    CHECK(row.at("yardstick_high") == "nan");
  }
  const Said enough = compare(full, sector, options);
  CHECK(has(enough.text, "drawn 1000 times from the 4 wedges of the 2 reference runs"));
  for (const Row& row : rows_of(options.csv)) CHECK(row.at("beyond") != "nan");
  // A vessel has but two halves.
  for (const char* file : result_files) rewrite(full[0] + "/results/" + file, "wedge_n4_", "wedge_n2_");
  const Said halves = compare({full[0]}, study.sectors(1, 0, 180));
  CHECK(has(halves.text, "a vessel has only 2 of them: name 2 reference runs (seeds) or more\n"));
}

TEST_CASE("Velocities of a bed at rest are left out where nothing of them is resolved", "[compare]") {
  Study study;
  const auto full = study.full(2), sector = study.sectors(2, 0);
  std::vector<std::string> folders = full;
  folders.insert(folders.end(), sector.begin(), sector.end());
  for (const std::string& folder : folders) {
    lay_to_rest(folder, "settle");
    rewrite(folder + "/results/scalars.csv", ",cn,-,", ",speed,m/s,");
    rewrite(folder + "/results/radial.csv", ",cn\n", ",speed_spread [m/s]\n");
  }
  CompareOptions options;
  options.csv = study.path("rows.csv");
  const auto velocities = [&](const std::string& moment) {
    int rows = 0;
    for (const Row& row : rows_of(options.csv))
      rows += row.at("moment") == moment && row.at("quantity") != "cn" ? 1 : 0;
    return rows;
  };
  const Said rest = compare(full, sector, options);
  CHECK(has(rest.text, "moment settle\n  velocities: at rest, none is resolved\n"));
  CHECK_FALSE(has(rest.text, "moment flow_mean\n  velocities"));
  CHECK(velocities("settle") == 0);
  CHECK(velocities("flow_mean") == 2 + 6 + 3);
  CHECK(rows_of(options.csv).size() == 2 + 6 + 3 + 2 * 3);  // cn of the maps of both moments stays

  const auto judged = [&](const std::string& text) {
    options.tolerance = study.file("t.toml", "[[tolerance]]\nrelative = 100\n" + text);
    return compare(full, sector, options).code;
  };
  CHECK(judged("quantity = \"vz\"\n") == 0);  // of the other moment
  CHECK(has(complaint([&] { judged("moment = \"settle\"\nquantity = \"vz\"\n"); }), "fits no row"));
  options.tolerance.clear();

  lay_to_rest(sector[0], "settle", true);  // one grain of one run moves
  CHECK_FALSE(has(compare(full, sector, options).text, "velocities: at rest"));
  CHECK(velocities("settle") == 2 + 6 + 3);
}

TEST_CASE("A run named twice is refused, two of one scene and seed are pointed out", "[compare]") {
  Study study;
  const auto full = study.full(3), sector = study.sectors(1, 0);
  const std::string again = full[0] + "/../" + fs::path(full[0]).filename().string();
  const Said twice = compare({full[0], full[1], again}, sector);
  CHECK(twice.code == 2);
  CHECK(twice.text.empty());
  CHECK(has(twice.errors, "the reference runs name one run twice: " + full[0] + " and " + again));
  CHECK(compare(full, {sector[0], sector[0]}).code == 2);

  const std::string says = "warning: " + full[0] + ", " + full[1] + ": the same scene and seed";
  rewrite(full[2] + "/scene.resolved.toml", "[particles]\n", "[particles]\nseed = 3\n");
  CHECK(has(compare(full, sector).text, says));
  rewrite(full[1] + "/scene.resolved.toml", "[particles]\n", "[run]\nthreads = 2\n[particles]\n");
  CHECK(has(compare(full, sector).text, says));  // however it was run
  rewrite(full[1] + "/scene.resolved.toml", "[particles]\n", "[particles]\nseed = 2\n");
  CHECK_FALSE(has(compare(full, sector).text, "the same scene and seed"));
}
