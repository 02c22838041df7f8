// test_run_folder.cpp: what a run leaves in its folder: refusals, failed starts, ends of stages, full precision.
#include <filesystem>
#include <iostream>
#include <sstream>

#include "apps/commands/commands.hpp"
#include "apps/run/simulation.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/provenance.hpp"
#include "io/tables/state_csv.hpp"
#include "kernels/passes/measure.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;
const std::vector<std::string> briefly = {"stage.settle.until=0.01", "stage.discharge.until=0.01"};

/// What `work` writes to a stream.
template <class Work>
std::string written_to(std::ostream& stream, Work&& work) {
  const std::ostringstream text;
  std::streambuf* const before = stream.rdbuf(text.rdbuf());
  try {
    work();
  } catch (...) {
    stream.rdbuf(before);
    throw;
  }
  stream.rdbuf(before);
  return text.str();
}

template <class Work>
std::string complaint(Work&& work) {
  try {
    work();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no complaint";
}

Simulation resumed(const std::string& folder) {
  return Simulation::resume(read_scene(folder + "/scene.resolved.toml", {}), RunFolder(folder));
}

/// The scene with its grains from a file of two.
RunArguments two_grains(const std::string& folder, const std::string& distance) {
  write_text_file_atomically(
      folder + ".csv",
      "id,x,y,z,vx,vy,vz,wx,wy,wz,radius,material\n0,0.010,0.003,0.1,0,0,0,0,0,0,0.0025,grain\n1," + distance +
          ",0.003,0.1,0,0,0,0,0,0,0.0025,grain\n");
  std::vector<std::string> overrides = briefly;
  overrides.push_back("particles.file=" + folder + ".csv");
  overrides.push_back("particles.material=grain");
  return arguments_for(folder, 1, overrides);
}

}  // namespace

TEST_CASE("a folder that holds another run is refused and left alone", "[run]") {
  const ScratchFolder scratch;
  RunArguments a = arguments_for(scratch.path() + "/taken", 1, briefly);
  CHECK(command_run(a) == exit_code::ok);
  const std::string before = read_text_file(scratch.path() + "/taken/series/energies.csv");
  CHECK_THROWS_AS(command_run(a), FileError);
  CHECK(read_text_file(scratch.path() + "/taken/series/energies.csv") == before);
  a.folder = scratch.path() + "/nothing";
  CHECK_THROWS_AS(command_resume(a), FileError);
}

TEST_CASE("a folder that is no run's is refused in one line", "[run]") {
  const ScratchFolder scratch;
  const std::string none = scratch / "none", file = scratch / "file", empty = scratch / "empty";
  write_text_file_atomically(file, "x");
  fs::create_directory(empty);
  const std::string remedy = "; name the folder that `wedge run SCENE.toml -o FOLDER` made";
  for (const auto& [folder, what] :
       {std::make_pair(none, std::string(": there is no such folder")),
        std::make_pair(file, std::string(": is a file, not the folder of a run")),
        std::make_pair(empty, std::string(": is not the folder of a run: scene.resolved.toml is missing"))}) {
    const std::string says = folder + what + remedy;
    ExportArguments out;
    out.folder = folder;
    out.format = "csv";
    RunArguments a;
    a.folder = folder;
    CHECK(complaint([&, name = folder] { command_status(name); }) == says);
    CHECK(complaint([&] { command_export(out); }) == says);
    CHECK(complaint([&, name = folder] { command_compare({name}, {name}); }) == says);
    CHECK(complaint([&] { command_resume(a); }) == says);
  }
}

TEST_CASE("a start with deep overlaps leaves a report and a crash frame, and nothing to resume", "[run]") {
  const ScratchFolder scratch;
  const std::string folder = scratch / "crash";
  const RunArguments bad = two_grains(folder, "0.0105");
  std::string what;
  try {
    command_run(bad);
  } catch (const PhysicsError& error) {
    what = error.what();
  }
  CHECK_THAT(what, Contains("grains 0 and 1") && Contains("Likely cause"));
  CHECK_THAT(what, Contains(folder + "/frames/crash_particles.hdf") && Contains("Nothing is there to resume"));
  CHECK(fs::exists(folder + "/frames/crash_particles.hdf"));
  CHECK(read_progress(folder + "/progress.json").state == "failed");
  CHECK_THAT(read_progress(folder + "/progress.json").message, Contains("grains 0 and 1"));
  CHECK_THAT(complaint([&] { command_resume(bad); }), Contains("broke down before its first step"));
  CHECK_THAT(written_to(std::cout, [&] { command_status(folder); }),
             Contains("failed") && Contains("grains 0 and 1"));
  CHECK(command_run(two_grains(folder, "0.016")) == exit_code::ok);  // into the same folder
  CHECK_FALSE(fs::exists(folder + "/frames/crash_particles.hdf"));
  CHECK(read_progress(folder + "/progress.json").state == "finished");
}

TEST_CASE("the end of each stage keeps a checkpoint that another run can start from", "[run]") {
  const ScratchFolder scratch;
  const std::string base = scratch.path() + "/", folder = base + "run";
  RunArguments a = arguments_for(folder, 1, {"stage.settle.until=0.03", "stage.discharge.until=0.03"});
  a.until = 0.02;
  CHECK(command_run(a) == exit_code::ok);
  CHECK_FALSE(fs::exists(folder + "/checkpoints/stage_settle.hdf"));
  const std::string early = *newest_valid_checkpoint(folder + "/checkpoints");
  fs::copy_file(early, base + "early.hdf");
  a.until = 0.03;
  CHECK(command_resume(a) == exit_code::ok);
  const std::uint64_t settled = state_hash(resumed(folder).state());
  a.until.reset();
  CHECK(command_resume(a) == exit_code::ok);
  CHECK(checkpoint_is_valid(folder + "/checkpoints/stage_settle.hdf"));
  CHECK(checkpoint_is_valid(folder + "/checkpoints/stage_discharge.hdf"));

  // A scene of the discharge alone begins from the settled bed; the folder itself still means the newest
  // checkpoint.
  std::string text = read_text_file(a.scene);
  const std::string settle = "[[stage]]\nname = \"settle\"\nuntil = 0.15\n";
  text.erase(text.find(settle), settle.size());
  const Scene from_stage =
      parse_scene(text, "s.toml", {"start.from=" + folder + "/checkpoints/stage_settle.hdf"}, "");
  const Simulation next = Simulation::begin(from_stage, RunFolder(base + "next"));
  CHECK(state_hash(next.state()) == settled);
  CHECK(next.state().vessel.present(2));  // the plug, which the stage then removes
  const Simulation last =
      Simulation::begin(parse_scene(text, "s.toml", {"start.from=" + folder}, ""), RunFolder(base + "last"));
  CHECK(state_hash(last.state()) == state_hash(resumed(folder).state()));

  // Going back to before the stage's end: its checkpoint goes, until it ends again.
  for (const auto& entry : fs::directory_iterator(folder + "/checkpoints"))
    if (entry.path().filename().string().rfind("checkpoint_", 0) == 0) fs::remove(entry.path());
  fs::copy_file(base + "early.hdf", early);
  (void)resumed(folder);
  CHECK_FALSE(fs::exists(folder + "/checkpoints/stage_settle.hdf"));
  CHECK_FALSE(fs::exists(folder + "/checkpoints/stage_discharge.hdf"));
  a.until = 0.031;
  CHECK(command_resume(a) == exit_code::ok);
  CHECK(fs::exists(folder + "/checkpoints/stage_settle.hdf"));
}

TEST_CASE("names of stages become names of files that every system takes", "[run]") {
  CHECK(RunFolder("r").stage_checkpoint("settle-2") == "r/checkpoints/stage_settle-2.hdf");
  CHECK(RunFolder("r").slice("a/b c") == "r/results/slice_a%2Fb%20c.svg");
}

TEST_CASE("a finished run that is resumed stays as it is", "[run]") {
  const ScratchFolder scratch;
  RunArguments a = arguments_for(scratch / "run", 1, briefly);
  CHECK(command_run(a) == exit_code::ok);
  const std::string checkpoint = *newest_valid_checkpoint(a.folder + "/checkpoints");
  const std::string log = read_text_file(a.folder + "/run.log");
  const auto written = fs::last_write_time(checkpoint);
  const std::string last_stage = a.folder + "/checkpoints/stage_discharge.hdf";
  fs::remove(last_stage);
  CHECK(command_resume(a) == exit_code::ok);
  CHECK(fs::last_write_time(checkpoint) == written);
  CHECK(read_text_file(a.folder + "/run.log") == log);
  CHECK(checkpoint_is_valid(last_stage));  // as after a kill just before it got its second name
  CHECK(read_progress(a.folder + "/progress.json").state == "finished");
  CHECK(read_progress(a.folder + "/progress.json").time_step == 2e-5);
}

TEST_CASE("a table of a frame is exact where a checkpoint is of the same step", "[run]") {
  const ScratchFolder scratch;
  const RunArguments a =
      arguments_for(scratch / "run", 1, {"stage.settle.until=0.06", "stage.discharge.until=0.01"});
  CHECK(command_run(a) == exit_code::ok);
  const State last = [&] {
    const Simulation run = resumed(a.folder);
    State copy;
    copy.particles = run.state().particles;
    return copy;
  }();
  ExportArguments out;
  out.folder = a.folder;
  out.format = "csv";
  out.output = scratch / "last.csv";
  CHECK_THAT(written_to(std::cerr, [&] { command_export(out); }), Contains("full precision from " + a.folder));
  const Particles read = read_state_csv(out.output, {}, {"grain", "wall"});
  REQUIRE(read.count() == last.particles.count());
  CHECK(read.id == last.particles.id);
  CHECK(read.velocity.z == last.particles.velocity.z);
  for (std::size_t i = 0; i < read.id.size(); ++i)  // positions have further slots for images
    if (read.position.x[i] != last.particles.position.x[i]) FAIL("grain " << read.id[i] << " was rounded");
  fs::remove(checkpoint_path(a.folder + "/checkpoints", 3000));
  out.frame = 2;  // the end of the stage "settle", at step 3000
  CHECK_THAT(written_to(std::cerr, [&] { command_export(out); }), Contains("stage_settle.hdf"));
  out.frame = 1;  // at 0.05 s no checkpoint was written
  CHECK_THAT(written_to(std::cerr, [&] { command_export(out); }), Contains("is in single precision"));
}

TEST_CASE("a start without grains is legal but spoken of", "[run]") {
  const ScratchFolder scratch;
  write_text_file_atomically(scratch / "empty.csv", "id,x,y,z,vx,vy,vz,wx,wy,wz,radius,material\n");
  std::vector<std::string> overrides = briefly;
  overrides.push_back("particles.file=" + (scratch / "empty.csv"));
  overrides.push_back("particles.material=grain");
  const RunArguments a = arguments_for(scratch / "run", 1, overrides);
  CHECK_THAT(written_to(std::cout, [&] { command_check(a.scene, a.overrides, 1); }),
             Contains("particles.file: '" + (scratch / "empty.csv") + "' holds no grains"));
  CHECK(command_run(a) == exit_code::ok);
  RunArguments without_step = a;
  without_step.folder = scratch / "other";
  without_step.overrides.push_back("time.step=auto");
  CHECK_THROWS_WITH(command_run(without_step), Contains("no grain is there") && Contains("time.step"));
  CHECK_FALSE(fs::exists(without_step.folder + "/scene.toml"));
}

TEST_CASE("check refuses what a run would refuse of its start", "[run]") {
  const ScratchFolder scratch;
  const RunArguments a = arguments_for(scratch / "run", 1, {});
  const auto check = [&](const std::string& override) {
    return complaint([&] { written_to(std::cout, [&] { command_check(a.scene, {override}, 1); }); });
  };
  CHECK_THAT(check("particles.file=" + (scratch / "no.csv")), Contains("does not exist"));
  CHECK_THAT(check("start.from=" + (scratch / "no")), Contains("does not exist"));
  CHECK_THAT(check("start.from=" + scratch.path()), Contains("holds no valid checkpoint to start from"));
}
