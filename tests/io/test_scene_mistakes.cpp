// test_scene_mistakes.cpp: the messages about scenes that are wrong, impossible or doubtful.
#include <string>
#include <vector>

#include "tests/support/sound_scene.hpp"

using namespace wedge;
using namespace wedge::test;

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
  refused("domain.kind=graded", "kind 'graded' is known but not built yet; use full, sector or slot");
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
  refused({"wall.shell.material=rigid"}, "add [contact.grain-rigid] with sliding");
  refused({"particles.material=rigid"}, "only walls can be rigid");
  refused({"particles.diameter=-0.005"}, "'diameter' must be above 0, not -0.005");  // and no length in d says more
  refused({"material.grain.young=1e400"}, "no double can hold 1e400");
  refused({"material.rigid.density=1", "material.rigid.young=1", "material.rigid.poisson=0"},
          "'rigid' is the name of a wall without any compliance and cannot be described");
  refused({"time.step=4e-5"}, "% of the Rayleigh time");
  refused({"stage.settle.time_step=1"}, "--set stage.settle.time_step=1: error: a time step of 1 s");
  refused({"domain.angle=2.4"}, "the sector is too thin");
  refused({"contact.grain-grain.rolling=0.0011"}, "exceeds the smallest radius, 0.001 m");
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
  refused({"domain.inner_radius=0.01"}, "the axis 'clamp' has no inner radius");
  refused({"domain.axis_material=steel"}, "is made of nothing");
  refused({"contact.rolling=none", "contact.rolling_velocity=relative"}, "only applies to rolling");
  refused({"contact.rolling_damping=0.3"}, "only applies to rolling");
  refused({"particles.speed=fast"}, "'speed' must be a number, not a string");
  refused({"domain.outlet.z=0.01"}, "the outlet lies above the bottom of the fill region");
  refused({"stage.open.until.discharged=1001"}, "only 1000 grains are in this domain");
  refused({"domain.gravity=[0, 0, 0]"}, "without gravity, rest has no natural scale");
  refused({"contact.stiffness=1"}, "'stiffness' does not apply to the law 'mindlin_deresiewicz'");
  refused({"contact.law=linear"}, "needs stiffness = N/m or contact_time = s");
  refused({"contact.law=linear", "contact.contact_time=1e-3", "contact.grain-grain.damping=1.2"},
          "a contact with critical or stronger damping has no 'contact_time'");
  refused({"stage.open.add=[\"shell\"]"}, "the wall 'shell' is already present");
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
  warned({"particles.count=4001"}, "is not divisible by 4");
  warned({"contact.rolling=none"}, "has no effect");
  warned({"contact.grain-grain.damping=1.5"}, "critical or above");
  warned({"stage.open.at_most=0"}, "may never end");
}
