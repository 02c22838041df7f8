// test_scene_file.cpp: scene files: the shipped ones, the round trip, and what is said of wrong ones.
#include <algorithm>
#include <clocale>
#include <string>
#include <vector>

#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/scene_diagnostics.hpp"
#include "io/scene_file.hpp"
#include "tests/catch.hpp"

using namespace wedge;

namespace {

const std::string scene_folder = std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/";

/// A sound scene of few lines; tests spoil it by overrides or by replacing a line.
const std::string sound = R"([domain]
angle = 90
outlet = { z = "-10 d" }
[[wall]]
name = "shell"
profile = [["20 d", 0], ["20 d", 0.2]]
material = "steel"
[[wall]]
name = "floor"
profile = [[0, 0], ["20 d", 0]]
material = "steel"
[material.grain]
density = 2500
young = 1e7
poisson = 0.3
[material.steel]
density = 7800
young = 2e11
poisson = 0.25
[contact]
[contact.grain-grain]
sliding = 0.6
rolling = "0.02 d"
[contact.steel-grain]
sliding = 0.5
restitution = 0.8
[particles]
diameter = 0.002
material = "grain"
count = 4000
region = { r = [0, "20 d"], z = [0, 0.2] }
[[stage]]
name = "settle"
until = "at rest"
at_most = 1
[[stage]]
name = "open"
remove = ["floor"]
until = { discharged = 20 }
at_most = 1
)";

std::string replaced(std::string text, const std::string& line, const std::string& with) {
  const std::size_t at = text.find(line);
  REQUIRE(at != std::string::npos);
  return text.replace(at, line.size(), with);
}

Scene parse(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parse_scene(text, "s.toml", overrides, "/data/scenes");
}

/// What is said of a wrong scene; "" when it is accepted.
std::string complaint(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse(text, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

int count_errors(const std::string& text) {
  int errors = 0;
  for (std::size_t at = text.find(": error: "); at != std::string::npos; at = text.find(": error: ", at + 1))
    ++errors;
  return errors;
}

const RandomFill& fill_of(const Scene& scene) { return std::get<RandomFill>(scene.particles.grains); }

void check_round_trip(const Scene& scene) {
  const std::string resolved = resolved_scene(scene);
  const Scene again = parse_scene(resolved, "resolved", {}, "");
  CHECK(resolved_scene(again) == resolved);
  CHECK(again.domain.order == scene.domain.order);
  CHECK(again.domain.gravity == scene.domain.gravity);
  CHECK(again.domain.outlet_height == scene.domain.outlet_height);
  REQUIRE(again.walls.size() == scene.walls.size());
  for (std::size_t w = 0; w < scene.walls.size(); ++w) CHECK(again.walls[w].profile == scene.walls[w].profile);
  REQUIRE(again.interactions.entries().size() == scene.interactions.entries().size());
  for (std::size_t p = 0; p < scene.interactions.entries().size(); ++p) {
    CHECK(again.interactions.entries()[p].rolling == scene.interactions.entries()[p].rolling);
    CHECK(again.interactions.entries()[p].restitution == scene.interactions.entries()[p].restitution);
    CHECK(again.interactions.entries()[p].given == scene.interactions.entries()[p].given);
  }
  CHECK(again.time_step == scene.time_step);
  CHECK(again.stages.size() == scene.stages.size());
}

}  // namespace

TEST_CASE("the shipped scenes can be read whole and by the slice", "[scene]") {
  for (const std::string name : {"hopper", "hopper_small", "sandpile"}) {
    for (const int order : {1, 4, 6, 8, 12}) {
      CAPTURE(name, order);
      const Scene scene =
          read_scene(scene_folder + name + ".toml", {"domain.angle=" + std::to_string(360 / order)});
      CHECK(scene.domain.order == order);
      CHECK(scene.domain.kind == (order == 1 ? DomainKind::full : DomainKind::sector));
      CHECK(scene_warnings(scene) == std::vector<std::string>{});
      CHECK(fill_of(scene).count % order == 0);
      check_round_trip(scene);
    }
  }
}

TEST_CASE("the hopper is the paper's", "[scene]") {
  const Scene scene = read_scene(scene_folder + "hopper.toml", {});
  CHECK(fill_of(scene).count == 120000);
  CHECK(mean_diameter(scene.particles) == 0.005);
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].name == "grain");  // in the order of the file
  CHECK(scene.walls[1].name == "floor");
  CHECK(scene.walls[1].profile[0] == Eigen::Vector2d(0.02, 0));
  CHECK(scene.walls[1].profile[1] == scene.walls[0].profile[0]);
  CHECK(scene.interactions(1, 0).sliding == 0.5);
  CHECK(scene.interactions(0, 0).rolling == Approx(1e-4).epsilon(1e-15));
  CHECK_FALSE(scene.interactions(1, 1).given);
  CHECK(std::holds_alternative<UntilAtRest>(scene.stages[0].until));
  CHECK(std::get<UntilTime>(scene.stages[1].until).duration == 0.7);
  CHECK(scene.stages[1].remove == std::vector<std::string>{"plug"});
  // Derived numbers of the scene, from its table of data by hand.
  CHECK(rayleigh_time(scene) == Approx(2.667e-4).epsilon(2e-4));
  CHECK(collision_time(scene, 0.1) / scene.time_step == Approx(42).margin(0.5));
  const Scene pile = read_scene(scene_folder + "sandpile.toml", {});
  CHECK(collision_time(pile, 1.0) / pile.time_step == Approx(14).margin(0.5));
}

TEST_CASE("everything a scene can say survives the round trip", "[scene]") {
  std::string text =
      replaced(sound, "diameter = 0.002",
               "sizes = [{ diameter = 0.002, fraction = 0.25 }, { diameter = 0.003, fraction = 0.75 }]");
  text = replaced(text, "[contact]\n", "[contact]\nlaw = \"linear\"\ncontact_time = 1e-3\ntension = \"none\"\n");
  text += R"([rest]
speed = 1e-4
[time]
step = "auto"
[output]
frames = 0.1
at = [0.05, 1]
precision = "double"
energy_budget = false
[start]
from = "other/run"
[run]
skin = "0.1 d"
threads = 3
)";
  const Scene scene = parse(text, {"wall.shell.spin=3", "wall.floor.present=true", "particles.seed=77",
                                   "stage.open.time_step=1e-5", "contact.grain-steel.sliding=0.1"});
  CHECK(mean_diameter(scene.particles) == 0.25 * 0.002 + 0.75 * 0.003);
  CHECK(scene.start_from == "/data/scenes/other/run");
  CHECK(scene.interactions(0, 1).sliding == 0.1);
  CHECK(scene.interactions(0, 1).restitution == 0.8);
  CHECK(scene.walls[0].spin == 3);
  CHECK(scene.particles.seed == 77);
  check_round_trip(scene);
  const Scene again = parse(resolved_scene(scene));
  CHECK(again.output.frames_at == std::vector<double>{0.05, 1});
  CHECK(again.output.precision == FramePrecision::double_precision);
  CHECK_FALSE(again.output.energy_budget);
  CHECK(again.run.skin == scene.run.skin);
  CHECK(again.stages[1].time_step == 1e-5);
  CHECK(std::get<UntilDischarged>(again.stages[1].until).count == 20);
  CHECK(again.contact.contact_time == 1e-3);
  CHECK(again.contact.tension == Tension::none);
}

TEST_CASE("size distributions, slots and files of grains", "[scene]") {
  const Scene uniform = parse(sound, {"particles.diameter={uniform=[0.001, 0.003]}"});
  CHECK(mean_diameter(uniform.particles) == Approx(0.002).epsilon(1e-14));
  CHECK(mean_power_of_diameter(uniform.particles, 3) == Approx(1e-8).epsilon(1e-14));  // (81 - 1) / (4 * 2) mm3
  check_round_trip(uniform);
  const Scene lognormal =
      parse(sound, {"particles.diameter={lognormal={median=0.002, sigma=0.1, smallest=0.0001, largest=0.02}}"});
  CHECK(mean_diameter(lognormal.particles) == Approx(0.002 * std::exp(0.005)).epsilon(1e-10));
  CHECK(smallest_diameter(lognormal.particles) == 0.0001);
  check_round_trip(lognormal);

  std::string slot = replaced(sound, "angle = 90", "kind = \"slot\"\nwidth = \"4 d\"\ngravity = [1, 0, -9]");
  slot = replaced(slot, "r = [0, \"20 d\"]", "x = [\"-20 d\", \"20 d\"]");
  slot = replaced(slot, "count = 4000", "count = 2000");
  slot = replaced(slot, "[[0, 0], ", "[[\"-20 d\", 0], ");
  const Scene channel = parse(slot);
  CHECK(channel.domain.slot_width == 0.008);
  CHECK(fill_of(channel).r_low == -0.04);
  check_round_trip(channel);
  CHECK(contains(complaint(slot, {"domain.width=0.0021"}), "the slot is too narrow"));
  CHECK(contains(complaint(sound, {"domain.gravity=[1, 0, -9]"}), "gravity must lie along the axis"));

  std::string state = replaced(sound, "count = 4000\n", "file = \"state.csv\"\n");
  state = replaced(state, "region = { r = [0, \"20 d\"], z = [0, 0.2] }\n", "");
  const Scene from_file = parse(state);
  CHECK(std::get<StateFile>(from_file.particles.grains).path == "/data/scenes/state.csv");
  CHECK(std::get<StateFile>(from_file.particles.grains).diameter == 0.002);
  check_round_trip(from_file);
  const std::string unknown_size = complaint(replaced(state, "diameter = 0.002\n", ""));
  CHECK(contains(unknown_size, "s.toml:6:13: error: 'r' is given in diameters, but the diameter is not known"));
}

TEST_CASE("all mistakes of a file are told at once, with place, line, caret and remedy", "[scene]") {
  std::string text = replaced(sound, "angle = 90", "angle = 100");
  text = replaced(text, "material = \"steel\"", "materal = \"steel\"");
  text = replaced(text, "[material.grain]\ndensity", "[material.grain]\n  densty");
  text = replaced(text, "young = 2e11", "young = \"stiff\"");
  text = replaced(text, "poisson = 0.25", "poisson = 0.7");
  text = replaced(text, "restitution = 0.8", "damping = 0.3\nrestitution = 0.8");
  text = replaced(text, "remove = [\"floor\"]", "remove = [\"flor\"]");
  const std::string expected = R"(s.toml:2:9: error: an angle of 100 degrees does not divide 360
angle = 100
        ^ the nearest that do are 90 (4 sectors) and 120 (3 sectors)
s.toml:7:1: error: unknown key 'materal' in [[wall]]
materal = "steel"
^ did you mean 'material'?
s.toml:12:1: error: 'density' is missing in [material.grain]
[material.grain]
^ a density in kg/m3, such as 2500
s.toml:13:3: error: unknown key 'densty' in [material.grain]
  densty = 2500
  ^ did you mean 'density'?
s.toml:18:9: error: 'young' must be a number, not a string
young = "stiff"
        ^ a Young's modulus in Pa, such as 1e7
s.toml:19:11: error: 'poisson' must be at most 0.5, not 0.7
poisson = 0.7
          ^ a Poisson ratio above -1 and up to 0.5, such as 0.3
s.toml:27:15: error: both 'damping' and 'restitution' are given
restitution = 0.8
              ^ keep one of them
s.toml:39:11: error: unknown wall 'flor'
remove = ["flor"]
          ^ did you mean 'floor'?
--set particles.cuont=3: error: unknown key 'cuont' in [particles]
  did you mean 'count'?
--set wall.shel.spin=1: error: no wall is named 'shel'
  did you mean 'shell'?)";
  CHECK(complaint(text, {"particles.cuont=3", "wall.shel.spin=1"}) == expected);
}

TEST_CASE("the caret finds its column behind tabs and letters of several bytes", "[scene]") {
  const std::string text = replaced(sound, "profile = [[0, 0], [\"20 d\", 0]]",
                                    "\tprofile = [ [\"0 d\", \"0 \xC2\xB5\"], [\"20 d\", true]]\r");
  CHECK(complaint(text) ==
        "s.toml:10:22: error: 'z' is not a length: \"0 \xC2\xB5\"\n"
        "\tprofile = [ [\"0 d\", \"0 \xC2\xB5\"], [\"20 d\", true]]\n"
        "\t                    ^ write a number of metres, such as 0.1, or of mean diameters, such as \"20 d\"\n"
        "s.toml:10:39: error: 'z' must be a number, not true or false\n"
        "\tprofile = [ [\"0 d\", \"0 \xC2\xB5\"], [\"20 d\", true]]\n"
        "\t                                     ^ write profile = [[r, z], [r, z], ...]");
}

TEST_CASE("overrides are checked like the file", "[scene]") {
  CHECK(parse(sound, {"domain.angle=60", "domain.angle = 45"}).domain.order == 8);
  CHECK(std::holds_alternative<UntilAtRest>(parse(sound, {"stage.open.until=at rest"}).stages[1].until));
  CHECK(parse(sound, {"rest.speed=1e-3"}).rest.speed == 1e-3);
  CHECK(parse(sound, {"stage.settle.until.discharged=5"}).stages.size() == 2);
  CHECK(complaint(sound, {"domain.angle"}) ==
        "--set domain.angle: error: not of the form table.key=value\n"
        "  write --set table.key=value, such as --set domain.angle=90");
  CHECK(contains(complaint(sound, {"time.step=[1"}), "--set time.step=[1: error: the value cannot be read"));
  CHECK(contains(complaint(sound, {"material.grain.young=-1"}),
                 "--set material.grain.young=-1: error: 'young' must be above 0, not -1\n  a Young's modulus"));
  CHECK(contains(complaint(sound, {"=3"}), "'' is not a key"));
  CHECK(contains(complaint(sound, {"stage.opne.until=3"}), "did you mean 'open'?"));
  CHECK(contains(complaint(sound, {"contact.steel-steal.sliding=1"}), "did you mean 'steel-steel'?"));
  CHECK(contains(complaint(sound, {"particles.count=1\nx=2"}), "not of the form"));
}

TEST_CASE("options that are known but not built are refused by name", "[scene]") {
  const auto refused = [](const std::string& override, const std::string& says) {
    CAPTURE(override);
    CHECK(complaint(sound, {override}) == "--set " + override + ": error: " + says);
  };
  refused("domain.axis=core", "axis 'core' is known but not built yet; use clamp, images, pin, line or hollow");
  refused("run.precision=mixed", "precision 'mixed' is known but not built yet; use double");
  refused("wall.shell.material=rigid",
          "material 'rigid' is known but not built yet; use a material of high stiffness");
}

TEST_CASE("options of the axis and of the contact are read and written", "[scene]") {
  const auto again = [](const std::vector<std::string>& overrides) {
    return parse(resolved_scene(parse(sound, overrides)), {});
  };
  const Scene hollow = again({"domain.axis=hollow", "domain.inner_radius=0.01"});
  CHECK(hollow.domain.axis == AxisRule::hollow);
  CHECK(hollow.domain.inner_radius == 0.01);
  CHECK(again({"domain.axis=line"}).domain.axis == AxisRule::line);
  CHECK(again({"contact.rolling_velocity=relative"}).contact.rolling_velocity == RollingVelocity::relative);
  const Scene spring = again({"contact.rolling=elastic_plastic_spring", "contact.rolling_damping=0.7"});
  CHECK(spring.contact.rolling == RollingModel::elastic_plastic_spring);
  CHECK(spring.contact.rolling_damping == 0.7);
  CHECK(again({"contact.coulomb=total"}).contact.coulomb == Coulomb::total);
}

TEST_CASE("what cannot be is refused", "[scene]") {
  const auto refused = [](const std::vector<std::string>& overrides, const std::string& says) {
    const std::string text = complaint(sound, overrides);
    CAPTURE(text, says);
    CHECK(contains(text, says));
    CHECK(count_errors(text) == 1);
  };
  // 0.30 pi 0.04^2 0.2 / (pi/6 0.002^3) = 72 000 grains fit in the region.
  CHECK(complaint(sound, {"particles.count=72000"}).empty());
  refused({"particles.count=96000"}, "use at most count = 72000, or a region 0.2667 m high");
  refused({"time.step=4e-5"}, "% of the Rayleigh time");
  refused({"stage.settle.time_step=1"}, "--set stage.settle.time_step=1: error: a time step of 1 s");
  refused({"domain.angle=2.4"}, "the sector is too thin");
  refused({"contact.grain-grain.rolling=0.0011"}, "longer than the smallest radius, 0.001 m");
  refused({"contact.grain-grain.sliding=-0.1"}, "'sliding' must be at least 0, not -0.1");
  refused({"contact.steel-grain.restitution=0"}, "'restitution' must be above 0, not 0");
  refused({"material.steel.poisson=-1"}, "'poisson' must be above -1, not -1");
  refused({"material.steel.density=0"}, "'density' must be above 0");
  refused({"material.grain.young=nan"}, "'young' must be a finite number");
  refused({"particles.count=2.5"}, "'count' must be a whole number, not 2.5");
  refused({"particles.count=many"}, "'count' must be a whole number, not a string");
  refused({"stage.settle.until=later"}, "write until = 0.7 (s), \"at rest\", \"empty\" or { discharged = 1000 }");
  refused({"stage.settle.until=emty"}, "did you mean 'empty'? Or write until = 0.7 (s), \"at rest\"");
  refused({"particles.region.r=[0.04, 0.01]"}, "'r' must rise");
  refused({"domain.axis=hollow"}, "'inner_radius' is missing");
  refused({"domain.inner_radius=0.01"}, "only the axis 'hollow' has an inner radius");
  refused({"domain.axis_material=steel"}, "is made of nothing");
  refused({"contact.rolling=none", "contact.rolling_velocity=relative"}, "has a meaning for rolling");
  refused({"contact.rolling_damping=0.3"}, "has a meaning for rolling");
  refused({"particles.speed=fast"}, "'speed' must be a number, not a string");
  refused({"domain.outlet.z=0.01"}, "the outlet lies above the bottom of the fill region");
  refused({"stage.open.until.discharged=1001"}, "only 1000 grains are in this domain");
  refused({"domain.gravity=[0, 0, 0]"}, "without gravity, rest has no natural scale");
  refused({"contact.stiffness=1"}, "for the law 'linear' only");
  refused({"contact.law=linear"}, "needs stiffness = N/m or contact_time = s");
  refused({"contact.law=linear", "contact.contact_time=1e-3", "contact.grain-grain.damping=1.2"},
          "a contact damped critically or more has no 'contact_time'");
  refused({"stage.open.add=[\"shell\"]"}, "the wall 'shell' is there already");
  refused({"wall.floor.present=false"}, "the wall 'floor' is not there to be removed");
  refused({"wall.floor.profile=[[0, 0], [-0.04, 0]]"}, "'r' must be at least 0");
  refused({"domain.kind=full"}, "a full vessel has an angle of 360 degrees, not 90");
  refused({"particles.sizes=[{diameter=0.002}]"}, "both 'diameter' and 'sizes' are given");
  refused({"gravity=3"}, "key outside of every table: 'gravity'");
}

TEST_CASE("every pair that can meet must be described", "[scene]") {
  const std::string without = replaced(sound, "[contact.steel-grain]\nsliding = 0.5\nrestitution = 0.8\n", "");
  CHECK(complaint(without) ==
        "s.toml:20:1: error: the pair 'grain-steel' can meet but is not described\n[contact]\n"
        "^ add [contact.grain-steel] with sliding, rolling and damping or restitution");
  const std::string twice = replaced(sound, "[particles]", "[contact.grain-steel]\nsliding = 0.1\n[particles]");
  CHECK(
      contains(complaint(twice), "s.toml:27:10: error: the pair 'grain-steel' is already given as 'steel-grain'"));
}

TEST_CASE("broken TOML and missing files say where", "[scene]") {
  CHECK(contains(complaint("[domain]\nangle = \n"), "s.toml:2:9: error: "));
  CHECK(contains(complaint(replaced(sound, "young = 1e7", "young = 1e7\nyoung = 2e7")), "s.toml:15:"));
  CHECK(contains(complaint(replaced(sound, "[[stage]]\nname = \"settle\"", "[[stage]]\nname = 3")),
                 "'name' must be a string, not a number"));
  CHECK(count_errors(complaint("")) >= 4);
  CHECK_THROWS_AS(read_scene("/no/such/scene.toml", {}), FileError);
}

TEST_CASE("doubtful scenes are accepted with a warning", "[scene]") {
  CHECK(scene_warnings(parse(sound)).empty());
  const auto warned = [](const std::vector<std::string>& overrides, const std::string& says) {
    const std::vector<std::string> warnings = scene_warnings(parse(sound, overrides));
    CAPTURE(warnings, says);
    CHECK(std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return contains(w, says); }));
  };
  warned({"time.step=2e-5"}, "% of the Rayleigh time");
  warned({"wall.floor.profile=[[0, 0], [\"19.95 d\", 0]]"}, "nearly join: they are 0.0001 m (0.05 d) apart");
  warned({"wall.floor.profile=[[0, 0.01], [\"20 d\", 0.01]]"}, "passes through the fill region");
  warned({"particles.count=4001"}, "does not divide by 4");
  warned({"contact.rolling=none"}, "has no effect");
  warned({"contact.grain-grain.damping=1.5"}, "critical or above");
  warned({"stage.open.at_most=0"}, "may never end");
}

TEST_CASE("numbers are read and written free of locale", "[scene]") {
  const char* const german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const Scene scene = parse(sound, {"domain.outlet.z=-1.5 d", "time.step=1.25e-5"});
  const std::string resolved = resolved_scene(scene);
  std::setlocale(LC_ALL, "C");
  CAPTURE(german != nullptr);
  CHECK(scene.domain.outlet_height == -0.003);
  CHECK(contains(resolved, "step = 1.25e-05\n"));
  CHECK(resolved_scene(parse(resolved)) == resolved);
}

TEST_CASE("distances between words and shortest numbers", "[scene]") {
  CHECK(edit_distance("density", "densty") == 1);
  CHECK(edit_distance("count", "cuont") == 1);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(suggestion("hertz", {"linear", "hertz_mindlin"}) == "did you mean 'hertz_mindlin'?");
  CHECK(suggestion("zzzzzz", {"a", "b", "c"}) == "use a, b or c");
  CHECK(plain_number(0.1) == "0.1");
}

TEST_CASE("a collision of two equal spheres lasts as Chung and Ooi say", "[scene]") {
  // Chung, Ooi, Granular Matter 13 (2011) 643: two spheres of R 10 mm at +-10 m/s; glass 40.34 us, limestone 54.20
  // us.
  CHECK(collision_time(0.01, {"glass", 2800, 4.8e10, 0.20}, 20) == Approx(40.34e-6).epsilon(2e-4));
  CHECK(collision_time(0.01, {"limestone", 2500, 2e10, 0.25}, 20) == Approx(54.20e-6).epsilon(2e-4));
}
