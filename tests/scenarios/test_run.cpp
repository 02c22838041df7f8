// test_run.cpp: whole runs: the same answer for any number of threads, after a restart and from run to run;
// ledgers; refusals.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "apps/commands/commands.hpp"
#include "apps/run/simulation.hpp"
#include "apps/setup/setup.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/checkpoint.hpp"
#include "io/scene/scene_file.hpp"
#include "io/tables/csv.hpp"
#include "kernels/passes/measure.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/little_hopper.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

struct Outcome {
  std::uint64_t hash;
  std::string energies, discharge, ledger, walls;
};

Outcome outcome_of(const std::string& folder) {
  const RunFolder run(folder);
  Scene scene = read_scene(run.resolved_scene(), {});
  const Simulation last = Simulation::resume(std::move(scene), run);  // the finished run's last checkpoint
  return {state_hash(last.state()), read_text_file(run.series("energies")), read_text_file(run.series("discharge")),
          read_text_file(run.series("ledger")), read_text_file(run.series("walls"))};
}

void check_same(const Outcome& a, const Outcome& b) {
  CHECK(a.hash == b.hash);
  CHECK(a.energies == b.energies);
  CHECK(a.discharge == b.discharge);
  CHECK(a.ledger == b.ledger);
  CHECK(a.walls == b.walls);
}

std::vector<std::vector<double>> rows_of(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    for (const CsvField& f : split_csv_line(line)) {
      double x = 0;
      REQUIRE(parse_number(f.text, x) == NumberError::none);
      rows.back().push_back(x);
    }
  }
  return rows;
}

}  // namespace

TEST_CASE("a run gives the same bits for any number of threads, and after restarts", "[run]") {
  const ScratchFolder scratch;
  const std::string base = scratch.path() + "/";
  CHECK(command_run(arguments_for(base + "one", 1)) == exit_code::ok);
  const Outcome one = outcome_of(base + "one");
  for (const int threads : {2, 3, 8}) {
    const std::string folder = base + "threads" + std::to_string(threads);
    CHECK(command_run(arguments_for(folder, threads)) == exit_code::ok);
    check_same(outcome_of(folder), one);
  }
  SECTION("stopped three times and resumed, with other threads") {
    RunArguments a = arguments_for(base + "stopped", 2);
    a.until = 0.0731;
    CHECK(command_run(a) == exit_code::ok);
    for (const double until : {0.15, 0.2817}) {
      a.until = until;
      CHECK(command_resume(a) == exit_code::ok);
    }
    a.until.reset();
    a.threads = 1;
    CHECK(command_resume(a) == exit_code::ok);
    check_same(outcome_of(base + "stopped"), one);
    CHECK(std::filesystem::exists(base + "stopped/frames/particles_000011.hdf"));
  }
  SECTION("ledger, discharge and walls tell the truth") {
    for (const auto& row : rows_of(one.ledger)) CHECK(row[1] == row[2] + row[3]);
    const auto ledger = rows_of(one.ledger);
    CHECK(ledger.front()[1] == 250);
    CHECK(ledger.back()[3] == static_cast<double>(rows_of(one.discharge).size()));
    CHECK(ledger.back()[3] > 15);
    for (const auto& row : rows_of(one.discharge)) CHECK(row[1] <= row[0]);
    const auto energies = rows_of(one.energies);
    for (const auto& row : energies)
      CHECK(std::fabs(row.back()) <
            0.02 * energies.front()[6]);  // residual against the potential energy at the start
  }
}

TEST_CASE("a discharge may start from another run's bed, with its contact histories", "[run]") {
  const ScratchFolder scratch;
  const std::string base = scratch.path() + "/";
  RunArguments a = arguments_for(base + "bed", 1);
  a.until = 0.15;
  CHECK(command_run(a) == exit_code::ok);
  const Simulation bed =
      Simulation::resume(read_scene(base + "bed/scene.resolved.toml", {}), RunFolder(base + "bed"));
  Scene next = read_scene(base + "bed/scene.resolved.toml", {"start.from=" + base + "bed"});
  const Simulation start = Simulation::begin(next, RunFolder(base + "next"));
  CHECK(state_hash(start.state()) == state_hash(bed.state()));  // histories are in the hash
  CHECK(start.state().time == 0);
  CHECK(start.state().put_in == bed.state().particles.count());
  // Forces at the start are those the bed had: nothing jumps.
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bed.state().particles.count()); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(start.state().particles.count()); ++j) {
      if (bed.state().particles.id[i] != start.state().particles.id[j]) continue;
      largest = std::max(largest, norm(bed.state().particles.force.get(i)));
      worst = std::max(worst, norm(bed.state().particles.force.get(i) - start.state().particles.force.get(j)));
    }
  }
  CHECK(worst == 0);
  CHECK(largest > 0);
}

TEST_CASE("a run killed before its first step goes on as if never stopped", "[run]") {
  const ScratchFolder scratch;
  const auto short_run = [&](const std::string& name) {
    return arguments_for(scratch / name, 1, {"stage.settle.until=0.02", "stage.discharge.until=0.01"});
  };
  REQUIRE(command_run(short_run("whole")) == exit_code::ok);
  RunArguments killed = short_run("killed");
  {
    const RunFolder folder(killed.folder);
    std::filesystem::create_directories(folder.path());
    Scene scene = read_scene(killed.scene, killed.overrides);
    write_text_file_atomically(folder.scene(), scene.text);
    write_text_file_atomically(folder.resolved_scene(), resolved_scene(scene));
    const Simulation begun = Simulation::begin(std::move(scene), folder);  // and no more
  }
  REQUIRE(command_resume(killed) == exit_code::ok);
  check_same(outcome_of(scratch / "whole"), outcome_of(scratch / "killed"));
}

TEST_CASE("rows, frames, ends of stages and stops come in the first step at or after their time", "[run]") {
  // However many steps are done at once between two looks; times in steps of 20 us.
  const ScratchFolder scratch;
  const auto in_steps = [](double steps) { return std::to_string(steps * 2e-5); };
  RunArguments a = arguments_for(
      scratch / "run", 1,
      {"particles.count=60", "stage.settle.until=" + in_steps(551), "stage.discharge.at_most=" + in_steps(436),
       "output.series=" + in_steps(68.5), "output.frames=" + in_steps(245.5),
       "output.at=[" + in_steps(166.5) + ", " + in_steps(858.5) + "]"});
  a.until = 251 * 2e-5;
  REQUIRE(command_run(a) == exit_code::ok);
  const RunFolder folder(a.folder);
  const auto end = [&] { return Simulation::resume(read_scene(folder.resolved_scene(), {}), folder).state().step; };
  CHECK(end() == 251);
  a.until.reset();
  REQUIRE(command_resume(a) == exit_code::ok);
  CHECK(end() == 551 + 436);

  std::vector<double> rows, frames;  // steps
  for (const auto& row : rows_of(read_text_file(folder.series("energies")))) rows.push_back(row[1]);
  CHECK(rows ==
        std::vector<double>{0, 69, 137, 206, 274, 343, 411, 480, 548, 551, 617, 685, 754, 822, 891, 959, 987});
  State state = make_domain(read_scene(folder.resolved_scene(), {}));
  const std::string last = *newest_valid_checkpoint(folder.checkpoints());
  for (const double t : RunMemory::from_text(read_checkpoint(last, state).run_state, last).frame_times)
    frames.push_back(std::round(t / 2e-5));
  CHECK(frames == std::vector<double>{0, 167, 246, 491, 551, 737, 859, 982, 987});
}

TEST_CASE("a wall that a stage adds into the bed stops the run", "[run]") {
  const ScratchFolder scratch;
  RunArguments a = arguments_for(scratch / "run", 1,
                                 {"wall.plug.present=true", "stage.settle.until=0.1", "stage.discharge.remove=[]",
                                  "stage.discharge.add=[\"lid\"]"});
  std::ofstream(a.scene, std::ios::app) << "[[wall]]\nname = \"lid\"\nprofile = [[0, 0.01], [0.03, 0.01]]\n"
                                           "material = \"wall\"\npresent = false\n";
  CHECK_THROWS_WITH(command_run(a), Catch::Matchers::Contains("the wall 'lid' is added through grain"));
  CHECK(std::filesystem::exists(scratch / "run/frames/crash_particles.hdf"));
}

TEST_CASE("a run whose energy budget is broken warns, then stops, at the same step however it is run", "[run]") {
  const ScratchFolder scratch;
  const auto pot = [&](const std::string& name, int threads, const char* step) {
    RunArguments a;
    a.scene = std::string(WEDGE_SOURCE_DIR) + "/tests/scenarios/hard_cases/pot.toml";
    a.folder = scratch / name;
    a.threads = threads;
    a.overrides = {std::string("time.step=") + step};
    return a;
  };
  const auto error_of = [](const std::function<void()>& work) -> std::string {
    try {
      work();
    } catch (const PhysicsError& error) {
      return std::string(error.what()).substr(0, std::string(error.what()).find('\n'));
    }
    return "";
  };
  const auto warnings = [&](const std::string& name) {  // lines in the log
    std::vector<std::string> found;
    std::istringstream log(read_text_file(scratch / (name + "/run.log")));
    for (std::string line; std::getline(log, line);)
      if (line.rfind("warning: ", 0) == 0) found.push_back(line);
    return found;
  };
  const char* const broken = "6.67e-5";  // 25 % of the Rayleigh time
  const std::string error = error_of([&] { command_run(pot("one", 1, broken)); });
  CHECK_THAT(error, Catch::Matchers::Contains("the energy budget is broken in step ") &&
                        Catch::Matchers::Contains("Likely cause: the time step"));
  CHECK(error_of([&] { command_run(pot("four", 4, broken)); }) == error);
  CHECK(warnings("four") == warnings("one"));
  RunArguments stopped = pot("stopped", 1, broken);
  for (const double until : {0.06, 0.14, 0.15}) {  // before and after the warning
    stopped.until = until;
    CHECK((until < 0.1 ? command_run(stopped) : command_resume(stopped)) == exit_code::ok);
  }
  stopped.until.reset();
  CHECK(error_of([&] { command_resume(stopped); }) == error);
  CHECK(warnings("stopped") == warnings("one"));
  CHECK(read_text_file(scratch / "stopped/series/energies.csv") ==
        read_text_file(scratch / "one/series/energies.csv"));

  // Between steps that close and those that break, some runs doubt at many looks and say so once, also in two
  // parts.
  std::size_t warned = 0;
  for (const char* step : {"6.18e-5", "6.3e-5", "6.67e-5"}) {
    const std::string whole = std::string("whole") + step, parts = std::string("parts") + step;
    const std::string end = error_of([&] { command_run(pot(whole, 1, step)); });
    RunArguments part = pot(parts, 1, step);
    part.until = 0.15;
    CHECK(error_of([&] { command_run(part); }) == "");
    part.until.reset();
    CHECK(error_of([&] { command_resume(part); }) == end);
    CHECK(warnings(parts) == warnings(whole));
    CHECK(warnings(whole).size() <= 1);
    warned += warnings(whole).size();
  }
  CHECK(warned >= 1);

  RunArguments unasked = pot("unasked", 1, broken);  // no budget, no judgement
  unasked.overrides.push_back("output.energy_budget=false");
  CHECK(command_run(unasked) == exit_code::ok);
  CHECK(warnings("unasked").empty());
  CHECK(command_run(pot("good", 1, "5.33e-5")) == exit_code::ok);  // 20 %
  CHECK(warnings("good").empty());
  // A bed at rest has lost nothing, and the energy stored in its contacts with the floor goes with the floor.
  RunArguments opened = pot("opened", 1, "2e-5");
  opened.scene = std::string(WEDGE_SOURCE_DIR) + "/tests/scenarios/hard_cases/outlet.toml";
  opened.overrides.insert(opened.overrides.end(), {"start.from=" + (scratch / "good"), "stage.settle.until=0.001",
                                                   "stage.open.at_most=0.0002"});
  CHECK(command_run(opened) == exit_code::ok);
  CHECK(warnings("opened").empty());
}

TEST_CASE("the memory of a run reads back, and one of an older program has doubted nothing", "[run]") {
  RunMemory memory;
  memory.budget_doubted = true;
  memory.time_step = 0.1;
  auto text = memory.to_text();
  CHECK(RunMemory::from_text(text, "here").budget_doubted);
  CHECK(RunMemory::from_text(text, "here").time_step == 0.1);
  text.erase(
      std::remove_if(text.begin(), text.end(), [](const auto& entry) { return entry.first == "budget_doubted"; }),
      text.end());
  CHECK_FALSE(RunMemory::from_text(text, "here").budget_doubted);
}
