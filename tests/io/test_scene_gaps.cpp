// test_scene_gaps.cpp: which gaps between walls raise a warning, and which do not; sectors that are thin.
#include <string>
#include <vector>

#include "io/scene/scene_file.hpp"
#include "tests/support/catch.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

/// A hopper 20 d wide with an orifice of 6 d: d is 2 mm.
const std::string hopper = R"([domain]
angle = 90
outlet = { z = "-10 d" }
[[wall]]
name = "shell"
profile = [["10 d", 0], ["10 d", "50 d"]]
[[wall]]
name = "floor"
profile = [["3 d", 0], ["10 d", 0]]
[[wall]]
name = "plug"
profile = [[0, 0], ["3 d", 0]]
[material.grain]
density = 2500
young = 1e7
poisson = 0.3
[contact.grain-grain]
sliding = 0.6
[particles]
diameter = 0.002
count = 4000
region = { r = [0, "10 d"], z = [0, "40 d"] }
[[stage]]
name = "settle"
until = 0.1
[[stage]]
name = "open"
remove = ["plug"]
until = 0.1
)";

/// The warnings of the hopper with these overrides, one a line.
std::string warnings(const std::vector<std::string>& overrides, std::string text = hopper) {
  std::string all;
  for (const std::string& warning : scene_warnings(parse_scene(text, "s.toml", overrides, "")))
    all += (all.empty() ? "" : "\n") + warning;
  return all;
}

std::string without(std::string text, const std::string& line) {
  const std::size_t at = text.find(line);
  REQUIRE(at != std::string::npos);
  return text.erase(at, line.size());
}

std::string no_outlet() { return without(hopper, "outlet = { z = \"-10 d\" }\n"); }
std::string never_opens() { return without(no_outlet(), "remove = [\"plug\"]\n"); }

}  // namespace

TEST_CASE("gaps that are meant raise no warning", "[gaps]") {
  CHECK(warnings({}).empty());
  CHECK(warnings({}, never_opens()).empty());
  for (const std::string name : {"hopper", "hopper_small", "sandpile", "demo"}) {
    CAPTURE(name);
    const Scene scene = read_scene(std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/" + name + ".toml", {});
    CHECK(scene_warnings(scene) == std::vector<std::string>{});
  }
  // Open from the start, with an outlet; a lid that turns with little play; a dish wider than what falls into it.
  CHECK(warnings({}, without(without(hopper, "remove = [\"plug\"]\n"),
                             "[[wall]]\nname = \"plug\"\nprofile = [[0, 0], [\"3 d\", 0]]\n"))
            .empty());
  CHECK(warnings({"wall.plug.spin=3", "wall.plug.profile=[[0, 0], [\"2.9 d\", 0]]"}).empty());
  CHECK(warnings({"wall.shell.profile=[[\"10 d\", 0], [\"10 d\", \"2 d\"]]", "particles.region.r=[0, \"5 d\"]",
                  "particles.count=1000", "particles.region.z=[\"4 d\", \"40 d\"]"},
                 never_opens())
            .empty());
}

TEST_CASE("walls that nearly join are told, with both points, the width and a remedy", "[gaps]") {
  CHECK(
      warnings({"wall.floor.profile=[[\"3 d\", 0], [\"9.5 d\", 0]]"}) ==
      "the walls 'shell' and 'floor' nearly join: they are 0.001 m (0.5 d) apart, from (0.02, 0) to (0.019, 0) m; "
      "write the same point in both profiles if they should join");
  // Too far; beside the middle of a wall; an end that only a removed wall joined; a hole at the axis.
  CHECK_THAT(warnings({"wall.floor.profile=[[\"3 d\", 0], [\"10.05 d\", 0]]"}),
             Contains("0.0001 m (0.05 d) apart"));
  CHECK_THAT(warnings({"wall.shell.profile=[[\"10 d\", \"-5 d\"], [\"10 d\", \"50 d\"]]",
                       "wall.floor.profile=[[\"3 d\", 0], [0.0199, 0]]"}),
             Contains("from (0.0199, 0) to (0.02, 0) m"));
  CHECK(warnings({"wall.shell.profile=[[\"10 d\", \"-5 d\"], [\"10 d\", \"50 d\"]]"}).empty());
  CHECK(warnings({"wall.plug.profile=[[\"0.1 d\", 0], [\"3 d\", 0]]"}) ==
        "the wall 'plug' ends at (0.0002, 0) m and leaves a hole at the axis 0.0004 m (0.2 d) wide, which no grain "
        "passes; write r = 0 there if it should be closed");
}

TEST_CASE("a vessel that leaks before it is opened is told, with the gap", "[gaps]") {
  CHECK(
      warnings({"wall.floor.profile=[[\"3 d\", 0], [\"8.5 d\", 0]]"}) ==
      "in the stage 'settle' grains can get out of the vessel between the wall 'shell' at (0.02, 0) m and the wall "
      "'floor' at (0.017, 0) m, a gap 0.003 m (1.5 d) wide, before the stage 'open' opens it; close it, by a wall "
      "that a later stage removes if need be");
  CHECK_THAT(
      warnings({"wall.shell.profile=[[\"10 d\", \"1.2 d\"], [\"10 d\", \"50 d\"]]"}),
      Contains("'shell' at (0.02, 0.0024) m and the wall 'floor' at (0.02, 0) m, a gap 0.0024 m (1.2 d) wide"));
  CHECK_THAT(warnings({"wall.plug.profile=[[\"0.6 d\", 0], [\"3 d\", 0]]"}),
             Contains("through the hole inside the wall 'plug' at (0.0012, 0) m, 0.0024 m (1.2 d) wide"));
}

TEST_CASE("without an outlet no stage may let grains out", "[gaps]") {
  const std::string open = warnings({}, no_outlet());
  CHECK_THAT(open, Contains("in the stage 'open' grains can get out of the vessel through the hole inside the wall "
                            "'floor' at (0.006, 0) m, 0.012 m (6 d) wide, and no outlet takes them"));
  CHECK_THAT(open, Contains("add outlet = { z = ... } to [domain]"));
  // A plate without a rim; a slit half way up the shell.
  CHECK_THAT(warnings({"wall.shell.profile=[[\"10 d\", 0], [\"10 d\", \"-2 d\"]]",
                       "particles.region.r=[0, \"5 d\"]", "particles.count=1000"},
                      never_opens()),
             Contains("which do not close it below and at the side, and no outlet takes them"));
  CHECK_THAT(warnings({"wall.shell.profile=[[\"10 d\", 0], [\"10 d\", \"20 d\"]]"},
                      never_opens() +
                          "[[wall]]\nname = \"upper\"\nprofile = [[\"10 d\", \"22 d\"], [\"10 d\", \"50 d\"]]\n"),
             Contains("a gap 0.004 m (2 d) wide"));
}

TEST_CASE("a sector with an arc below 4 d at the wall is told to be thin", "[gaps]") {
  CHECK(warnings({"domain.angle=24", "particles.count=3000"}).empty());  // 2 pi 10 d / 15 = 4.19 d
  CHECK(warnings({"domain.angle=22.5", "particles.count=3200"}) ==       // 2 pi 10 d / 16 = 3.93 d
        "the sector is thin: at the largest radius, 0.02 m, its arc is 3.93 d long; below 4 d coordination numbers "
        "come out too low everywhere; use an angle of at least 24 degrees");
}
