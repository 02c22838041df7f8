// bench_step.cpp: how many particle-steps per second does the whole step do? Needs a compiler and Eigen's headers
// only.
//
//   bench_step --case column --particles N --threads T --rolling on|off --steps S [--angle DEGREES] [--settle
//   SECONDS]
//              [--budget on|off] [--start FILE] [--write FILE]
//
// Case `column`: hopper grains (PHYSICS section 4) in a flat-bottomed cylinder of diameter 0.2 m, settled from a
// random fill, or from the places in the --start file (lines "x y z" [m], then settled as long), then timed; the
// --write file gets the settled places. The last line is `particle_steps_per_second <number>`: the median of five
// windows of S steps.
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "core/parallel.hpp"
#include "kernels/fill.hpp"
#include "kernels/time_step.hpp"

namespace {

using namespace wedge;
constexpr double dt = 2.26e-5;  // s, the paper's

Scene column_scene(long particles, bool rolling, int order) {
  Scene s;
  s.domain.order = order;
  s.domain.kind = order > 1 ? DomainKind::sector : DomainKind::full;
  s.materials = {{"grain", 3800, 1e7, 0.3}, {"wall", 3800, 1e7, 0.3}};
  s.interactions = PairTable<Interaction>(2);
  for (int a = 0; a < 2; ++a) {
    Interaction& c = s.interactions(a, 0);
    c.sliding = a == 0 ? 0.6 : 0.5;
    c.rolling = rolling ? 0.02 * 0.005 : 0;
    c.damping_normal = c.damping_tangential = 0.3;
  }
  const double d = 0.005, radius = 0.1;
  const double height = static_cast<double>(particles) * (3.14159265358979 / 6) * d * d * d /
                        (0.27 * 3.14159265358979 * radius * radius);
  WallDescription wall;
  wall.name = "vessel";
  wall.profile = {{0, 0}, {radius, 0}, {radius, 3 * height + 1}};
  wall.material = 1;
  s.walls = {wall};
  RandomFill fill;
  fill.sizes = std::vector<SizeClass>{{d, 1, 0}};
  fill.count = particles;
  fill.r_high = radius;
  fill.z_high = height + d;
  fill.speed = 0.05;
  s.particles.grains = fill;
  return s;
}

void read_places(State& state, const Scene& scene, const std::string& path) {
  std::ifstream file(path);
  std::vector<Vec3> places;
  if (!file) throw std::runtime_error("cannot read " + path);
  for (Vec3 x; file >> x.x >> x.y >> x.z;) places.push_back(x);
  Particles& p = state.particles;
  p.resize(static_cast<Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    p.position.set(i, places[i]);
    p.velocity.set(i, {});
    p.angular_velocity.set(i, {});
    p.radius[i] = 0.0025;
    p.material[i] = 0;
    p.id[i] = static_cast<std::int32_t>(i);
  }
  complete_grains(p, scene.materials, 0.005);
}

void write_places(const State& state, const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) throw std::runtime_error("cannot write " + path);
  for (std::size_t i = 0; i < static_cast<std::size_t>(state.particles.count()); ++i) {
    const Vec3 x = state.particles.position.get(i);
    std::fprintf(file, "%.12g %.12g %.12g\n", x.x, x.y, x.z);
  }
  if (std::fclose(file) != 0) throw std::runtime_error("cannot write " + path);
}

int bench(int argc, char** argv) {
  std::map<std::string, std::string> option{{"case", "column"},      {"particles", "32000"}, {"threads", "1"},
                                            {"precision", "double"}, {"rolling", "on"},      {"steps", "500"},
                                            {"angle", "360"},        {"settle", "0.7"},      {"budget", "on"},
                                            {"start", ""},           {"write", ""}};
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strncmp(argv[i], "--", 2) != 0 || !option.count(argv[i] + 2)) {
      std::fprintf(stderr, "bench_step: unknown option %s\n", argv[i]);
      return 2;
    }
    option[argv[i] + 2] = argv[i + 1];
  }
  if (option["case"] != "column" || option["precision"] != "double") {
    std::fprintf(stderr, "bench_step: only --case column and --precision double are built\n");
    return 2;
  }
  set_thread_count(std::atoi(option["threads"].c_str()));
  const int steps = std::atoi(option["steps"].c_str());
  Scene scene = column_scene(std::atol(option["particles"].c_str()), option["rolling"] == "on",
                             static_cast<int>(360 / std::atof(option["angle"].c_str()) + 0.5));
  scene.output.energy_budget = option["budget"] == "on";
  State state;
  if (scene.domain.order > 1) state.symmetry = Symmetry::rotation(scene.domain.order);
  state.vessel = Vessel(scene);
  if (option["start"].empty()) {
    fill_at_random(state, scene, std::get<RandomFill>(scene.particles.grains));
  } else {
    read_places(state, scene, option["start"]);
  }
  describe_grains(state);
  TimeStep settle(scene, state);
  settle.start(state, dt);
  const auto settle_begin = std::chrono::steady_clock::now();
  while (state.time < std::atof(option["settle"].c_str())) settle.advance(state, dt);
  const double settle_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - settle_begin).count();

  if (!option["write"].empty()) write_places(state, option["write"]);

  TimeStep step(scene, state);
  const double n = state.particles.count();
  const auto builds = state.list_builds;
  std::vector<double> rates;
  for (int window = 0; window < 5; ++window) {
    const auto begin = std::chrono::steady_clock::now();
    for (int done = 0; done < steps;) done += step.advance(state, dt, steps - done);
    rates.push_back(n * steps / std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(rates.begin(), rates.end());
  long touching = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(state.contacts.rows()); ++k)
    touching += row_overlap(state, k) > 0;
  std::printf(
      "grains %.0f images %d pairs/grain %.3f contacts/grain %.3f lists %lld in %d steps; settling %.0f "
      "particle-steps/s\n",
      n, state.images.count(), state.contacts.rows() / n, static_cast<double>(touching) / n,
      static_cast<long long>(state.list_builds - builds), 5 * steps,
      n * static_cast<double>(state.step - 5 * steps) / settle_seconds);
  double total = 0;
  for (const auto& [pass, t] : step.stopwatch().times()) total += t.seconds;
  for (const auto& [pass, t] : step.stopwatch().times())
    std::printf("%-20s %6.1f ns per particle-step  %5.1f %%\n", pass.c_str(), 1e9 * t.seconds / (n * 5 * steps),
                100 * t.seconds / total);
  const Energies e = step.energies(state);
  std::printf("kinetic energy per grain %.3g J\n", (e.kinetic + e.rotational) / n);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("peak memory per grain %.0f B\n", 1024.0 * static_cast<double>(usage.ru_maxrss) / n);
  std::printf("slowest %.0f fastest %.0f\n", rates.front(), rates.back());
  std::printf("particle_steps_per_second %.0f\n", rates[2]);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return bench(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_step: %s\n", error.what());
    return 1;
  }
}
