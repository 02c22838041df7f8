// test_same_answer.cpp: the same bits for any number of threads and after a stop at any step, with every option
// that has a pass of its own.
#include <random>

#include "apps/commands/commands.hpp"
#include "apps/run/simulation.hpp"
#include "core/parallel.hpp"
#include "kernels/neighbours/reaction_map.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/same_run.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace wedge;
using namespace wedge::test;

namespace {

/// A sector with more grains than four tiles hold, so that eight threads have something to share.
const std::vector<std::string> crowd = {"wall.shell.profile=[[0.06, 0], [0.06, 0.6]]",
                                        "wall.floor.profile=[[0.02, 0], [0.06, 0]]",
                                        "particles.count=26004",
                                        "particles.region={r=[0, 0.06], z=[0, 0.5]}",
                                        "domain.gravity=[0, 0, -60]",
                                        "stage.settle.until=0.014",
                                        "stage.discharge.until=0.004",
                                        "output.frames=0.009",
                                        "output.series=0.001"};

const std::vector<std::vector<std::string>> options = {
    {},
    {"contact.rolling_velocity=relative"},
    {"contact.rolling=elastic_plastic_spring"},
    {"domain.axis=images"},
    {"run.precision=mixed"},
    {"domain.axis=pin"},
    {"domain.axis=line"},
    {"domain.axis=hollow", "domain.inner_radius=0.006"},
    {"contact.law=hertz_mindlin", "contact.coulomb=total", "wall.shell.spin=5", "wall.floor.speed=0.2"},
    {"contact.law=linear", "contact.contact_time=1e-3", "contact.tension=none"}};

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string text_of(const std::vector<std::string>& overrides) {
  std::string text;
  for (const std::string& o : overrides) text += o + " ";
  return text;
}

/// A folder for a run whose scene has the same name as that of the others: titles tell it.
std::string place(const ScratchFolder& scratch, const std::string& name) {
  std::filesystem::create_directory(scratch / name);
  return scratch / name + "/run";
}

State last_state(const std::string& run) {
  const RunFolder folder(run);
  State state = make_domain(read_scene(folder.resolved_scene(), {}));
  read_checkpoint(*newest_valid_checkpoint(folder.checkpoints()), state);
  return state;
}

}  // namespace

TEST_CASE("1, 2, 3, 4 and 8 threads give the same bits", "[same]") {
  for (const auto& option : options) {
    INFO(text_of(option));
    const ScratchFolder scratch;
    const std::string one = place(scratch, "1");
    REQUIRE(command_run(arguments_for(one, 1, joined(crowd, option))) == exit_code::ok);
    const State state = last_state(one);
    CHECK(tile_count(state.particles.count()) > 4);
    CHECK(state.list_builds > 3);
    // All numbers of threads with the first option, the extremes with the others.
    for (const int threads : option.empty() ? std::vector<int>{2, 3, 4, 8} : std::vector<int>{4, 8}) {
      INFO(threads << " threads");
      const std::string folder = place(scratch, std::to_string(threads));
      REQUIRE(command_run(arguments_for(folder, threads, joined(crowd, option))) == exit_code::ok);
      check_same_run(folder, one);
    }
  }
}

TEST_CASE("a run stopped at any step goes on to the same bits", "[same]") {
  constexpr double dt = 2e-5;
  const std::vector<std::string> brief = {"particles.region={r=[0, 0.03], z=[0, 0.1]}", "stage.settle.until=0.02",
                                          "stage.discharge.until=0.02", "output.frames=0.01",
                                          "output.series=0.002"};
  std::mt19937 random(7);
  for (const auto& option : options) {
    INFO(text_of(option));
    const ScratchFolder scratch;
    const std::string whole = place(scratch, "whole");
    REQUIRE(command_run(arguments_for(whole, 1, joined(brief, option))) == exit_code::ok);
    // The first steps, the border of the stages from before to after, frames, and any.
    std::set<int> stops = {1, 2, 3, 499, 500, 501, 999, 1000, 1001, 1500, 1999, 2000};
    for (int k = 0; k < 10; ++k) stops.insert(static_cast<int>(1 + random() % 1998));
    RunArguments a = arguments_for(place(scratch, "stopped"), 1, joined(brief, option));
    bool begun = false;
    std::int64_t builds = 0, renewals = 0, stopped_at_renewal = 0;
    const auto stop_at = [&](std::int64_t step) {
      a.until = static_cast<double>(step) * dt;
      a.threads = 1 + static_cast<int>(random() % 4);
      REQUIRE((begun ? command_resume(a) : command_run(a)) == exit_code::ok);
      begun = true;
      const State state = last_state(a.folder);
      CHECK(state.step == step);
      renewals = state.list_builds - builds;
      builds = state.list_builds;
    };
    for (const int stop : stops) {
      if (begun && stop <= last_state(a.folder).step) continue;  // the way to a new list went past it
      stop_at(stop);
      if (stop != 3) continue;
      while (stopped_at_renewal == 0 && begun && last_state(a.folder).step < 400) {  // step by step to a new list
        stop_at(last_state(a.folder).step + 1);
        stopped_at_renewal = renewals;
      }
    }
    CHECK(stopped_at_renewal == 1);
    a.until.reset();
    REQUIRE(command_resume(a) == exit_code::ok);
    check_same_run(a.folder, whole);
  }
}
