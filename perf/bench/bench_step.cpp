// bench_step.cpp: how many particle-steps per second does the whole step do? Needs a compiler and Eigen's headers
// only.
//
//   bench_step --case column --particles N --threads T --precision double|mixed --rolling on|off --steps S
//              [--angle DEGREES] [--settle SECONDS]
//              [--budget on|off] [--start FILE] [--write FILE]
//   bench_step --signature [--precision double|mixed] [--threads T]
//
// Case `column`: hopper grains (Yang et al. 2014, Table 1) in a flat-bottomed cylinder of diameter 0.2 m, settled
// from a random fill, or from the places in the --start file (lines "x y z" [m], then settled as long), then timed;
// the
// --write file gets the settled places. The last line is `particle_steps_per_second <number>`: the median of five
// windows of S steps.
//
// With --signature: nothing is timed; a fixed small run, and one line `signature <hash of its last state>`, which
// tells whether a change of the code changed results.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>

#include "core/parallel.hpp"
#include "kernels/passes/measure.hpp"
#include "perf/bench/column.hpp"

namespace {

using namespace wedge;
using Options = std::map<std::string, std::string>;
constexpr int windows = 5;

struct BadOption : std::runtime_error {
  using std::runtime_error::runtime_error;
};

Options read_options(int argc, char** argv) {
  Options option{{"case", "column"}, {"particles", "32000"}, {"threads", "1"}, {"precision", "double"},
                 {"rolling", "on"},  {"steps", "500"},       {"angle", "360"}, {"settle", "0.7"},
                 {"budget", "on"},   {"start", ""},          {"write", ""},    {"signature", ""}};
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (name.rfind("--", 0) != 0 || !option.count(name.substr(2))) throw BadOption("unknown option " + name);
    if (name == "--signature") {
      option["signature"] = "on";
      continue;
    }
    if (i + 1 == argc) throw BadOption(name + " needs a value");
    option[name.substr(2)] = argv[++i];
  }
  if (option["case"] != "column") throw BadOption("only --case column is built");
  return option;
}

/// The first of two words that an option may be?
bool is_first(const Options& option, const std::string& name, const char* first, const char* second) {
  const std::string& value = option.at(name);
  if (value != first && value != second) throw BadOption("--" + name + " is " + first + " or " + second);
  return value == first;
}

/// A number of at least `least`.
double number(const Options& option, const std::string& name, double least) {
  const std::string& value = option.at(name);
  char* end = nullptr;
  const double result = std::strtod(value.c_str(), &end);
  if (value.empty() || *end != 0 || !(result >= least && result < 1e9))
    throw BadOption("--" + name + " needs a number of at least " + std::to_string(least) + ", not '" + value + "'");
  return result;
}

Precision precision_of(const Options& option) {
  return is_first(option, "precision", "mixed", "double") ? Precision::mixed : Precision::double_precision;
}

/// A fixed small run: grains that fall, meet and begin to rest, so that lists are made and contacts come and go.
void print_signature(Precision precision) {
  ColumnOptions small;
  small.precision = precision;
  small.particles = 2000;
  const Scene scene = column_scene(small);
  State state = column_state(scene, "");
  TimeStep step(scene, state);
  step.start(state, column_dt);
  for (int done = 0; done < 2000;) done += step.advance(state, column_dt, 2000 - done);
  std::printf("signature %016" PRIx64 "\n", state_hash(state));
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What the timed run did, pass by pass.
void report(const State& state, TimeStep& step, int steps) {
  const double n = state.particles.count();
  double total = 0;
  for (const auto& [pass, t] : step.stopwatch().times()) total += t.seconds;
  for (const auto& [pass, t] : step.stopwatch().times())
    std::printf("%-20s %6.1f ns per particle-step  %5.1f %%\n", pass.c_str(),
                1e9 * t.seconds / (n * windows * steps), 100 * t.seconds / total);
  const Energies e = step.energies(state);
  std::printf("kinetic energy per grain %.3g J\n", (e.kinetic + e.rotational) / n);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory per grain %.0f B\n", 1024.0 * static_cast<double>(usage.ru_maxrss) / n);
}

void time_column(Options option) {
  ColumnOptions column;
  column.particles = static_cast<long>(number(option, "particles", 1));
  column.friction = is_first(option, "rolling", "on", "off") ? Friction::rolling : Friction::sliding;
  column.order = static_cast<int>(360 / number(option, "angle", 1) + 0.5);
  column.energy_budget = is_first(option, "budget", "on", "off");
  column.precision = precision_of(option);
  const int steps = static_cast<int>(number(option, "steps", 1));
  const Scene scene = column_scene(column);
  State state = column_state(scene, option["start"]);
  const auto settle_begin = std::chrono::steady_clock::now();
  settle(scene, state, number(option, "settle", 0));
  const double settle_seconds = seconds_since(settle_begin);
  if (!option["write"].empty()) write_places(state, option["write"]);

  TimeStep step(scene, state);
  const double n = state.particles.count();
  const auto builds = state.list_builds, settle_steps = state.step;
  std::vector<double> rates;
  for (int window = 0; window < windows; ++window) {
    const auto begin = std::chrono::steady_clock::now();
    for (int done = 0; done < steps;) done += step.advance(state, column_dt, steps - done);
    rates.push_back(n * steps / seconds_since(begin));
  }
  std::sort(rates.begin(), rates.end());
  long touching = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k)
    touching += row_overlap(state, k) > 0;
  std::printf(
      "grains %.0f images %d pairs/grain %.3f contacts/grain %.3f lists %lld in %d steps; settling %.0f "
      "particle-steps/s\n",
      n, state.images.count(), state.contacts.rows() / n, static_cast<double>(touching) / n,
      static_cast<long long>(state.list_builds - builds), windows * steps,
      n * static_cast<double>(settle_steps) / settle_seconds);
  report(state, step, steps);
  std::printf("slowest %.0f fastest %.0f\n", rates.front(), rates.back());
  std::printf("particle_steps_per_second %.0f\n", rates[windows / 2]);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Options option = read_options(argc, argv);
    set_thread_count(static_cast<int>(number(option, "threads", 1)));
    if (option["signature"] == "on")
      print_signature(precision_of(option));
    else
      time_column(option);
    return 0;
  } catch (const BadOption& error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 1;
  }
}
