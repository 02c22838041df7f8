// test_kill.cpp: a run killed at random moments and resumed each time is the run that nobody killed.
// WEDGE_KILLS in the environment: how many kills (8 unless told).
#include <cstdlib>
#include <random>

#include "apps/commands/commands.hpp"
#include "tests/support/real_program.hpp"
#include "tests/support/same_run.hpp"

using namespace wedge;
using namespace wedge::test;
using Catch::Matchers::Contains;

namespace {

/// Runs a scene to its end in sessions that are killed; `left` kills are to be had still.
class KilledRun {
public:
  KilledRun(std::vector<std::string> run, std::string folder, double session, std::mt19937& random)
      : run_(std::move(run)), folder_(std::move(folder)), session_(session), random_(random) {}

  void to_its_end(int& left) {
    for (bool begun = false;;) {
      const std::string threads = std::to_string(1 + random_() % 3);
      std::vector<std::string> words = begun ? std::vector<std::string>{"resume", folder_} : run_;
      words.insert(words.end(), {"-j", threads});
      Program session = wedge_program(words);
      const double moment = session_ * std::uniform_real_distribution<double>(0, 1)(random_);
      if (left > 0 && !session.ends_within(moment)) {
        session.send(SIGKILL);
        --left;
      }
      const Ended ended = session.wait();
      INFO("kills left: " << left << "\n" << ended.output << ended.errors);
      if (ended.code == exit_code::ok) return;
      if (ended.code != 128 + SIGKILL) {  // refused: it was killed before there was anything to go on with
        REQUIRE(ended.code == exit_code::file);
        REQUIRE_THAT(ended.errors, Contains("stopped before its first step") || Contains("is missing") ||
                                       Contains("there is no such folder"));
        begun = false;
        continue;
      }
      begun = true;
    }
  }

private:
  std::vector<std::string> run_;  // the words that begin it
  std::string folder_;
  double session_;  // s: kills come at random within this time
  std::mt19937& random_;
};

}  // namespace

TEST_CASE("a run killed at random moments and resumed is the run that nobody killed", "[kill]") {
  const char* wanted = std::getenv("WEDGE_KILLS");
  int left = wanted != nullptr ? std::atoi(wanted) : 8;
  REQUIRE(left > 0);
  const ScratchFolder scratch;
  const std::string scene = scratch / "hopper.toml", whole = scratch / "whole";
  write_text_file_atomically(scene, short_hopper());
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(wedge_program({"run", scene, "-o", whole, "-j", "1"}).wait().code == exit_code::ok);
  const double needed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::mt19937 random(std::random_device{}());
  for (int runs = 0; left > 0; ++runs) {
    const std::string folder = scratch / ("killed" + std::to_string(runs));
    // Every other run has checkpoints at its start and at the ends of stages alone, as long runs have for a while.
    const std::string checkpoints = runs % 2 == 0 ? "output.checkpoints=600" : "output.checkpoints=0.01";
    KilledRun({"run", scene, "-o", folder, "--set", checkpoints}, folder, 0.6 * needed, random).to_its_end(left);
    check_same_run(folder, whole);
    std::filesystem::remove_all(folder);
  }
}
