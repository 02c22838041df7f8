// test_scene_file.cpp: scene files: the shipped ones, and the round trip.
#include <algorithm>
#include <clocale>
#include <string>
#include <vector>

#include "core/require.hpp"
#include "core/time_scales.hpp"
#include "io/scene/diagnostics.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/support/sound_scene.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

const std::string scene_folder = std::string(WEDGE_SOURCE_DIR) + "/apps/scenes/";

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

TEST_CASE("the automatic step is a tenth of the Rayleigh time, and shorter with strong damping", "[scene]") {
  Scene automatic = read_scene(scene_folder + "hopper.toml", {});
  automatic.time_step = 0;  // "auto": 10 % up to a damping ratio of 0.3, then less in proportion
  for (const auto& [damping, part] : {std::pair(0.1, 0.1), std::pair(0.3, 0.1), std::pair(0.6, 0.05)}) {
    Interaction& pair = automatic.interactions(0, 0);
    pair.damping_normal = 0.1;
    pair.damping_tangential = damping;
    CHECK(chosen_time_step(automatic) == Approx(part * rayleigh_time(automatic)));
    pair.restitution = restitution_of(automatic.contact.law, automatic.contact.tension, damping);
    CHECK(chosen_time_step(automatic) == Approx(part * rayleigh_time(automatic)));
    pair.restitution.reset();
  }
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
  CHECK(contains(unknown_size, "s.toml:3:16: error: 'z' is given in diameters, but the diameter is not known"));
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
  const Scene rigid = parse(resolved_scene(parse(replaced(sound, "material = \"steel\"", "material = \"rigid\"") +
                                                 "[contact.rigid-grain]\nsliding = 0.3\n")));
  REQUIRE(rigid.materials.size() == 3);
  CHECK(is_rigid(rigid.materials[static_cast<std::size_t>(rigid.walls[0].material)]));
  CHECK(rigid.interactions(0, 2).sliding == 0.3);
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
