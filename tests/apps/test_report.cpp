// test_report.cpp: wedge report on runs that were never run, with known numbers: every section, every image, and
// tables that hold what the files hold. Skipped, and said so, where there is no Python with matplotlib.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <set>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/real_program.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

namespace fs = std::filesystem;

/// A Python that can draw, or "".
std::string drawing_python() {
  for (const char* candidate : {"python3", "/usr/bin/python3"})
    if (std::system((std::string(candidate) + " -B -c 'import numpy, matplotlib' >/dev/null 2>&1").c_str()) == 0)
      return candidate;
  return "";
}

bool can_draw() {
  static const bool can = !drawing_python().empty();
  if (!can) WARN("skipped: no python3 with numpy and matplotlib (Debian: python3-matplotlib)");
  return can;
}

/// A synthetic run of `angle` and `seed` below `folder`.
std::string make_run(const ScratchFolder& folder, int angle, int seed, const std::string& more = "") {
  const std::string run = folder / ("runs/a" + std::to_string(angle) + "_s" + std::to_string(seed));
  fs::create_directories(run);
  const std::string command = drawing_python() + " -B " + WEDGE_SOURCE_DIR + "/tests/support/synthetic_run.py " +
                              run + " " + std::to_string(angle) + " " + std::to_string(seed) + " " + more;
  REQUIRE(std::system(command.c_str()) == 0);
  return run;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

bool has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

/// The row of a table of the page that begins with this heading, without tags, cells parted by blanks.
std::string row_after(const std::string& page, const std::string& section, const std::string& heading) {
  const std::size_t from = page.find(heading, page.find(section));
  if (from == std::string::npos) return "";
  const std::string row = page.substr(from, page.find("</tr>", from) - from);
  return std::regex_replace(row, std::regex("<[^>]*>"), " ");
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

}  // namespace

TEST_CASE("the page of two ensembles has every section, no image without data, and the numbers of the files",
          "[report]") {
  if (!can_draw()) return;
  ScratchFolder folder;
  for (const int seed : {1, 2, 3})
    for (const int angle : {360, 90, 60, 45}) make_run(folder, angle, seed);
  fs::create_directories(folder / "runs/comparisons");
  write(
      folder / "runs/comparisons/made_a90.csv",
      "kind,moment,region,quantity,unit,measure,reference,compared,value,low,high,relative,yardstick,yardstick_low,"
      "yardstick_high,beyond,reference_runs,compared_runs,bootstrap\n"
      "scalar,open,all,cn,,difference,4,4.5,0.5,0.4,0.6,0.125,0.01,-0.1,0.2,1,3,3,seeds\n"
      "distribution,open,all,vz,m/s,wasserstein,0.1,0.1,0.002,0.001,0.004,0.02,0.003,0.001,0.004,0,3,3,seeds\n");
  const Ended ended = wedge_program({"report", folder / "runs", "--title", "A title & more"}).wait();
  INFO(ended.errors);
  REQUIRE(ended.code == 0);
  CHECK(ended.errors.empty());
  const std::string page = read_text_file(folder / "runs/report/index.html");
  CHECK(has(page, "<h1>A title &amp; more</h1>"));
  for (const char* heading : {"What was run",
                              "At a glance",
                              "Flow pattern, open",
                              "Horizontal cut, open",
                              "Map of coordination number, open",
                              "Map of coordination number, flow_mean",
                              "Distribution of the coordination number",
                              "Coordination number against arc length",
                              "Corrected coordination number",
                              "Distributions of velocity",
                              "Network of normal forces, open",
                              "Distributions of total normal force",
                              "Distribution of contact forces",
                              "Discharge",
                              "Flow zones, flow_mean",
                              "Map of packing fraction",
                              "Map of pressure",
                              "Radial profiles",
                              "Mass at the axis",
                              "Wall time",
                              "All numbers",
                              "How narrow may a sector be?",
                              "Errors against the full vessel",
                              "Definitions",
                              "Provenance",
                              "Commands that reproduce this page"}) {
    INFO(heading);
    CHECK(has(page, heading));
  }
  for (const char* number : {"5", "6", "7", "8", "9", "10", "11", "12", "13", "14"})
    CHECK(has(page, "as the paper\u2019s Fig. " + std::string(number) + "<"));
  CHECK(has(page, "12 runs in 1 vessel."));  // each once, though its results lie in a folder of their own
  CHECK(count(page, "<img ") > 80);
  CHECK(count(page, "<img ") == count(page, "<img src=\"data:image/"));
  CHECK(count(page, "alt=\"\"") == 0);
  CHECK(count(page, "src=\"http") + count(page, "href=\"http") + count(page, "<script") == 0);

  // cn = 4 + seed / 10 in the files: mean 4.2, standard deviation 0.1.
  CHECK(has(row_after(page, ">All numbers</h3>", "<code>cn</code>"), "4.20 \u00b1 0.10"));
  CHECK(has(row_after(page, ">All numbers</h3>", "<code>discharge_rate</code> [1/s]"), "1020 \u00b1 10"));
  // Of 90 degrees the rate is 0.925 times that; both have 95 % intervals of t(2) = 4.303 standard errors.
  CHECK(has(row_after(page, ">At a glance</h3>", "<code>discharge_rate</code>, flow_mean"),
            "\u22127.50 \u00b1 3.32 %"));
  CHECK(has(row_after(page, ">Table of errors: made</h3>", "<code>cn</code>"), "12.5 %"));
  CHECK(has(page, "<strong>12.5 %</strong>"));
  CHECK_FALSE(has(page, "<strong>2 %</strong>"));
  CHECK(has(page, "3 runs against 3"));
  CHECK(has(page, "wedge report " + (folder / "runs") + " -o "));
}

TEST_CASE("the smallest angle of a flow is above the first at which all sectors arched", "[report]") {
  if (!can_draw()) return;
  ScratchFolder folder;
  for (const int seed : {1, 2})
    for (const int angle : {360, 120, 90, 60}) make_run(folder, angle, seed, angle == 90 ? "12 4 1" : "12 4 0");
  const Ended ended = wedge_program({"report", folder / "runs", "-o", folder / "page.html"}).wait();
  INFO(ended.errors);
  REQUIRE(ended.code == 0);
  const std::string page = read_text_file(folder / "page.html");
  // CN at rest, of distinct neighbours (not there), in flow (twice), packing, speed, rate, mass at the axis, force;
  // then three rules.
  const std::string row = row_after(page, ">Smallest angles</h3>", "D = 12 d");
  std::vector<std::string> angles;
  const std::regex cell("(\u2013|\\d+\u00b0)");
  for (std::sregex_iterator at(row.begin(), row.end(), cell), end; at != end; ++at) angles.push_back(at->str());
  CHECK(angles == std::vector<std::string>{"60\u00b0", "\u2013", "120\u00b0", "\u2013", "60\u00b0", "120\u00b0",
                                           "120\u00b0", "120\u00b0", "120\u00b0", "0\u00b0", "104\u00b0",
                                           "86\u00b0"});
  CHECK(has(page, "mass at r &lt; d<br>"));
}

TEST_CASE("the page of sandpiles has the paper's figures of them and the angles of repose", "[report]") {
  if (!can_draw()) return;
  ScratchFolder folder;
  for (const int seed : {1, 2, 3})
    for (const int angle : {360, 90}) make_run(folder, angle, seed, "20 0");
  const Ended ended = wedge_program({"report", folder / "runs", "-o", folder / "page.html"}).wait();
  INFO(ended.errors);
  REQUIRE(ended.code == 0);
  const std::string page = read_text_file(folder / "page.html");
  CHECK(has(page, "Sandpile, vessel 20 d wide"));
  for (const char* number : {"16", "16, horizontal cut", "17", "18", "19", "20", "21", "22"})
    CHECK(has(page, "as the paper’s Fig. " + std::string(number) + "<"));
  CHECK(has(page, "Angle of repose</h3>"));
  CHECK(has(row_after(page, ">All numbers</h3>", "<code>angle_of_repose</code> [deg]"), "32.0 ± 1.0"));
}

TEST_CASE("a run whose files are partly missing is shown without those figures", "[report]") {
  if (!can_draw()) return;
  ScratchFolder folder;
  const std::string run = make_run(folder, 90, 1);
  for (const char* file :
       {"map.csv", "slice.csv", "network.csv", "cut.csv", "flow.csv", "distributions.csv", "scalars.csv"})
    fs::remove(run + "/results/" + file);
  const std::string page_file = folder / "page.html";
  const Ended ended = wedge_program({"report", run, "-o", page_file}).wait();
  INFO(ended.errors);
  REQUIRE(ended.code == 0);
  const std::string page = read_text_file(page_file);
  CHECK_FALSE(has(page, "Flow pattern"));
  CHECK(has(page, "Coordination number against arc length"));
  CHECK(has(row_after(page, ">All numbers</h3>", "<code>cn</code>"), "4.1"));  // of the summary
  CHECK(count(page, "<img ") == count(page, "<img src=\"data:image/"));
}

TEST_CASE("report says in one line what is missing", "[report]") {
  ScratchFolder folder;
  const Ended nothing = wedge_program({"report", folder / "none"}).wait();
  CHECK(nothing.code == 4);
  CHECK(has(nothing.errors, "no such folder"));

  setenv("WEDGE_PYTHON", "/none/python3", 1);
  const Ended without = wedge_program({"report", folder.path(), "-o", folder / "page.html"}).wait();
  unsetenv("WEDGE_PYTHON");
  CHECK(without.code == 4);
  CHECK(has(without.errors, "python3-matplotlib"));
  CHECK(count(without.errors, "\n") == 1);

  if (!can_draw()) return;
  const Ended empty = wedge_program({"report", folder.path(), "-o", folder / "page.html"}).wait();
  CHECK(empty.code == 4);
  CHECK(has(empty.errors, "wedge analyse"));
  CHECK(count(empty.errors, "\n") == 1);
  CHECK_FALSE(fs::exists(folder / "page.html"));
}
