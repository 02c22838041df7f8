// test_scene_sources.cpp: grains from a fill or from a file, and which of them an override means.
#include <string>
#include <vector>

#include "core/grain_sizes.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using Catch::Matchers::Contains;

namespace {

/// A scene with `particles` as its [particles].
std::string scene_with(const std::string& particles) {
  return "[domain]\n[[wall]]\nname = \"shell\"\nprofile = [[\"10 d\", 0], [\"10 d\", 0.1]]\n"
         "[[wall]]\nname = \"floor\"\nprofile = [[0, 0], [\"10 d\", 0]]\n"
         "[material.grain]\ndensity = 2500\nyoung = 1e7\npoisson = 0.3\n"
         "[contact.grain-grain]\nsliding = 0.6\nrolling = \"0.02 d\"\n"
         "[[stage]]\nname = \"settle\"\nuntil = 0.1\n[particles]\n" +
         particles;
}

const std::string fill =
    "diameter = 0.002\ncount = 100\nregion = { r = [0, 0.02], z = [0, 0.1] }\nspeed = 0.1\nseed = 7\n";

Scene parse(const std::string& particles, const std::vector<std::string>& overrides) {
  return parse_scene(scene_with(particles), "s.toml", overrides, "/data/scenes");
}

std::string complaint(const std::string& particles, const std::vector<std::string>& overrides) {
  try {
    parse(particles, overrides);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "accepted";
}

double shell_radius(const Scene& scene) { return scene.walls[0].profile[0].x(); }

}  // namespace

TEST_CASE("a file given on the command line replaces the fill of the scene", "[scene]") {
  const Scene scene = parse(fill, {"particles.file=/data/bed.csv"});
  const StateFile& file = std::get<StateFile>(scene.particles.grains);
  CHECK(file.path == "/data/bed.csv");
  CHECK(file.diameter == 0.002);  // for files without radii, and for lengths in d
  CHECK(shell_radius(scene) == 0.02);
  CHECK(resolved_scene(scene).find("count") == std::string::npos);

  // The vessel keeps its size when the sizes of the replaced fill are a distribution; radii are then the file's.
  std::string sizes = fill;
  sizes.replace(0, 16, "diameter = { uniform = [0.001, 0.003] }");
  const Scene spread = parse(sizes, {"particles.file=/data/bed.csv"});
  CHECK(std::get<StateFile>(spread.particles.grains).diameter == 0);
  CHECK(shell_radius(spread) == Approx(0.02).epsilon(1e-14));
  sizes.replace(0, sizes.find('\n'),
                "sizes = [{ diameter = 0.001, fraction = 0.5 }, { diameter = 0.003, fraction = 0.5 }]");
  CHECK(shell_radius(parse(sizes, {"particles.file=/data/bed.csv"})) == Approx(0.02).epsilon(1e-14));

  // Two sources on the command line are a contradiction, and so are two in the file.
  CHECK(complaint(fill, {"particles.file=/data/bed.csv", "particles.count=5"}) ==
        "--set particles.count=5: error: 'count' has no meaning when the grains come from a file\n"
        "  remove either it or 'file'");
  CHECK_THAT(complaint(fill + "file = \"bed.csv\"\n", {}),
             Contains("'count' has no meaning") && Contains("'speed'"));
}

TEST_CASE("a fill given on the command line replaces the file of the scene", "[scene]") {
  const std::string file = "file = \"bed.csv\"\ndiameter = 0.002\n";
  const Scene scene =
      parse(file, {"particles.count=50", "particles.region={ r = [0, 0.02], z = [0, 0.05] }", "particles.seed=3"});
  CHECK(std::get<RandomFill>(scene.particles.grains).count == 50);
  CHECK(scene.particles.seed == 3);
  CHECK(std::holds_alternative<StateFile>(parse(file, {"particles.seed=3"}).particles.grains));
  CHECK_THAT(complaint(file, {"particles.count=50"}), Contains("'region' is missing in [particles]"));
}

TEST_CASE("without a diameter in the scene, d is the mean of the file", "[scene]") {
  const ScratchFolder folder;
  const std::string header = "x,y,z,vx,vy,vz,wx,wy,wz,radius\n", bed = folder / "bed.csv";
  const std::string file = "file = \"" + bed + "\"\n";
  write_text_file_atomically(bed, header + "0,0,0,0,0,0,0,0,0,0.001\n0,0,0,0,0,0,0,0,0,0.002\n");
  const Scene scene = parse(file, {});
  CHECK(shell_radius(scene) == Approx(0.03).epsilon(1e-14));
  CHECK(std::get<StateFile>(scene.particles.grains).diameter == 0);  // radii stay the file's
  write_text_file_atomically(
      bed, header + "0,0,0,0,0,0,0,0,0,0.0035\n1,0,0,0,0,0,0,0,0,0.0035\n2,0,0,0,0,0,0,0,0,0.0035\n");
  CHECK(shell_radius(parse(file, {})) == 10 * 0.007);  // exact where all are equal
  for (const std::string& useless : {header, std::string("nonsense\n")}) {
    write_text_file_atomically(bed, useless);
    const std::string says = complaint(file, {});
    CHECK_THAT(says, Contains("'r' is given in diameters, but the diameter is not known"));
    CHECK_THAT(says, Contains("give [particles] a diameter or a file of grains that can be read"));
  }
}

TEST_CASE("what a scene is to start from must be there", "[scene]") {
  const ScratchFolder folder;
  const auto missing = [](const Scene& scene) {
    try {
      require_sources(scene);
    } catch (const FileError& error) {
      return std::string(error.what());
    }
    return std::string("there");
  };
  CHECK(missing(parse(fill, {})) == "there");
  CHECK_THAT(missing(parse(fill, {"particles.file=" + (folder / "no.csv")})),
             Contains("particles.file: '" + (folder / "no.csv") + "' does not exist"));
  CHECK_THAT(missing(parse(fill, {"start.from=" + (folder / "run")})),
             Contains("start.from: '" + (folder / "run") + "' does not exist"));
  CHECK(missing(parse(fill, {"start.from=" + folder.path(), "particles.file=no.csv"})) == "there");
}
