// test_stages.cpp: the record of stages, there and back; walls and the opening at a moment.
#include "apps/results/stages.hpp"

#include <cmath>

#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;

namespace {

Scene three_walls() {
  Scene scene;
  for (const char* name : {"shell", "plug; of \\ two", "gate"}) {
    WallDescription wall;
    wall.name = name;
    wall.profile = {{0, 0}, {1, 0}};
    scene.walls.push_back(wall);
  }
  scene.walls[2].speed = 0.5;
  scene.materials = {{"grain", 1000, 1e7, 0.3}};
  scene.interactions = PairTable<Interaction>(1);
  scene.stages.resize(3);
  scene.stages[1].remove = {"plug; of \\ two"};
  return scene;
}

const std::vector<StageRecord> record = {
    {"settle, then wait", 0, 0.25, StageEnd::at_rest, {"shell", "plug; of \\ two", "gate"}},
    {"open", 0.25, 1.0 / 3, StageEnd::discharged, {"shell", "gate"}},
    {"flow", 1.0 / 3, std::nan(""), StageEnd::running, {}}};

}  // namespace

TEST_CASE("The record of stages reads back as it was written") {
  const ScratchFolder scratch;
  const RunFolder folder(scratch.path());
  std::filesystem::create_directories(folder.results());
  write_stages(folder.stages(), record);
  const std::vector<StageRecord> back = read_stages(folder);
  REQUIRE(back.size() == record.size());
  for (std::size_t s = 0; s < record.size(); ++s) {
    CHECK(back[s].name == record[s].name);
    CHECK(back[s].begin == record[s].begin);
    CHECK((back[s].end == record[s].end || std::isnan(record[s].end)));
    CHECK(back[s].how == record[s].how);
    CHECK(back[s].walls == record[s].walls);
  }
  CHECK_FALSE(back[2].ended());
}

TEST_CASE("A record of stages that is missing or none is refused, with what to do") {
  const ScratchFolder scratch;
  const RunFolder folder(scratch.path());
  CHECK_THROWS_WITH(read_stages(folder),
                    Catch::Contains("stages.csv: is missing") && Catch::Contains("wedge run "));
  std::filesystem::create_directories(folder.results());
  for (const char* text : {"stage,begin [s]\n", "stage,begin [s],end [s],ended,walls\nsettle,0,1,time\n",
                           "stage,begin [s],end [s],ended,walls\nsettle,zero,1,time,\n",
                           "stage,begin [s],end [s],ended,walls\nsettle,0,1,somehow,\n"}) {
    write_text_file_atomically(folder.stages(), text);
    CHECK_THROWS_WITH(read_stages(folder), Catch::Contains("stages.csv:"));
  }
}

TEST_CASE("Walls at a moment are those of the stage that had begun before it, and moving ones have gone on") {
  const Scene scene = three_walls();
  const auto present = [&](double time) { return walls_present(vessel_at(scene, record, time)); };
  CHECK(present(0) == record[0].walls);
  CHECK(present(0.25) == record[0].walls);  // the last frame of the stage
  CHECK(present(0.26) == record[1].walls);
  CHECK(present(5).empty());
  CHECK(vessel_at(scene, record, 0.26).travel(2) == Approx(0.13));
  CHECK(*opening_time(scene, record) == 0.25);
  CHECK_FALSE(opening_time(scene, {record[0]}).has_value());
}
