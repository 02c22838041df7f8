// test_stages.cpp: the record of stages of a run that goes on from a checkpoint is that of the checkpoint at once.
#include <cmath>
#include <filesystem>

#include "apps/results/stages.hpp"
#include "apps/run/simulation.hpp"
#include "io/files/atomic_file.hpp"
#include "io/scene/scene_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

TEST_CASE("A stage that runs again after a resume has not ended, though it once had") {
  const ScratchFolder folder;
  const RunFolder run(folder / "run");
  REQUIRE(command_run(arguments_for(run.path(), 2, {"stage.settle.until=0.02", "stage.discharge.until=0.02"})) ==
          exit_code::ok);
  const std::string whole = read_text_file(run.stages());
  REQUIRE(read_stages(run).size() == 2);
  CHECK(read_stages(run)[1].how == StageEnd::time);

  // Back to the end of the first stage, and from there into the second.
  const std::string kept = folder / "settle.hdf";
  std::filesystem::copy_file(run.stage_checkpoint("settle"), kept);
  std::filesystem::remove_all(run.checkpoints());
  std::filesystem::create_directories(run.checkpoints());
  std::filesystem::copy_file(kept, run.checkpoints() + "/checkpoint_000000001000.hdf");
  RunArguments again;
  again.folder = run.path();
  again.threads = 2;
  again.until = 0.03;
  REQUIRE(command_resume(again) == exit_code::ok);
  REQUIRE(read_stages(run).size() == 2);
  CHECK_FALSE(read_stages(run)[1].ended());

  // A run that was killed between the end of a stage and its checkpoint has written the end already.
  write_text_file_atomically(run.stages(), whole);
  Simulation resumed = Simulation::resume(read_scene(run.resolved_scene(), {}), run);
  CHECK_FALSE(read_stages(run)[1].ended());
  CHECK(std::isnan(read_stages(run)[1].end));
  CHECK(resumed.run({}) == RunEnd::finished);
  CHECK(read_text_file(run.stages()) == whole);
}
