// bench_passes.cpp: what does each pass of the step cost on a settled column, in time and in bytes? Needs Google
// Benchmark.
//
//   bench_passes FOLDER [--benchmark_...]
//
// FOLDER holds the settled places column_<grains>.txt that perf/run.sh makes. Sizes without a file are left out.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "kernels/laws/mindlin_deresiewicz.hpp"
#include "perf/bench/column.hpp"
#include "perf/bench/pass_bytes.hpp"

namespace wedge {

extern template LawPasses make_law_passes<MindlinDeresiewicz>(const Scene&, const State&, Friction, bool);

namespace {

/// s: a step so short that it leaves the bed as it is, so that each call finds what the last one found.
constexpr double still = 1e-12;

/// A settled column.
struct SettledColumn {
  long grains;
  std::string places;  // file
  Grains kind;
  Precision precision;

  std::string name() const {
    constexpr const char* kinds[] = {"/alike/", "/sizes/", "/kinds/"};
    return kinds[static_cast<int>(kind)] + std::string(precision == Precision::mixed ? "mixed/" : "double/") +
           std::to_string(grains);
  }
};

/// A bed at rest, with forces and everything a pass reads.
struct Bed {
  Scene scene;
  State state;
  ForceSums sums;
  std::optional<NeighbourList> list;

  bool alike() const { return state.alike; }
  const ReactionMap& map() { return list->reactions(state); }
  LawPasses law(Friction friction) const {
    return make_law_passes<MindlinDeresiewicz>(scene, state, friction, alike());
  }
  /// Fresh sums of forces: some passes add to them each time they are called.
  void compute_forces() {
    const LawPasses passes = law(Friction::rolling);
    passes.evaluate_contacts(state, map(), sums, still);
    fold_reactions(state, map(), sums);
    passes.evaluate_walls(state, sums, still);
  }
};

/// The settled column. Made once for all benchmarks of its size.
Bed& settled_bed(const SettledColumn& c) {
  static std::map<std::string, std::unique_ptr<Bed>> beds;
  std::unique_ptr<Bed>& bed = beds[c.name()];
  if (!bed) {
    bed = std::make_unique<Bed>();
    ColumnOptions column;
    column.particles = c.grains;
    column.grains = c.kind;
    column.precision = c.precision;
    bed->scene = column_scene(column);
    bed->state = column_state(bed->scene, c.places, c.kind);
    settle(bed->scene, bed->state, 0.02);
    bed->list.emplace(PairRules{bed->scene.domain.axis, false}, 0.01 * bed->state.mean_diameter);
  }
  bed->compute_forces();
  return *bed;
}

/// A quarter of a vessel just filled, not settled: images do not care.
Bed& sector(long grains) {
  static std::map<long, std::unique_ptr<Bed>> beds;
  std::unique_ptr<Bed>& bed = beds[grains];
  if (!bed) {
    bed = std::make_unique<Bed>();
    ColumnOptions column;
    column.order = 4;
    column.particles = 4 * grains;
    bed->scene = column_scene(column);
    bed->state = column_state(bed->scene, "");
    TimeStep(bed->scene, bed->state).start(bed->state, column_dt);
  }
  return *bed;
}

constexpr double not_counted = 0;

/// Time and bytes of a call, and of each of its `count` grains or images.
void report(benchmark::State& bench, double count, double bytes) {
  using benchmark::Counter;
  bench.counters["each"] = Counter(count, Counter::kIsIterationInvariantRate | Counter::kInvert);
  if (bytes == not_counted) return;
  bench.counters["bytes_each"] = Counter(bytes / count);
  bench.counters["bytes"] = Counter(bytes, Counter::kIsIterationInvariantRate);
}

void add_contacts(const SettledColumn& c, const char* name, Friction friction) {
  benchmark::RegisterBenchmark((name + c.name()).c_str(), [=](benchmark::State& bench) {
    Bed& bed = settled_bed(c);
    const LawPasses law = bed.law(friction);
    for (auto _ : bench) law.evaluate_contacts(bed.state, bed.map(), bed.sums, still);
    report(bench, bed.state.particles.count(), contact_bytes(bed.state, bed.map(), friction));
    const double rows_each = bed.state.contacts.rows() / static_cast<double>(c.grains);
    bench.counters["rows_each"] = rows_each;
    if (friction == Friction::rolling && c.kind == Grains::alike) {
      bench.counters["operations_each"] = RowArithmetic::operations * rows_each;
      bench.counters["roots_each"] = RowArithmetic::roots * rows_each;
      bench.counters["divisions_each"] = RowArithmetic::divisions * rows_each;
    }
  });
}

void add_move(const SettledColumn& c, const char* name, Halves halves) {
  benchmark::RegisterBenchmark((name + c.name()).c_str(), [=](benchmark::State& bench) {
    Bed& bed = settled_bed(c);
    const BodyPasses bodies = make_body_passes(bed.scene, bed.state, Friction::rolling, bed.alike());
    const auto& move = halves == Halves::first    ? bodies.first_half
                       : halves == Halves::second ? bodies.second_half
                                                  : bodies.second_and_first_half;
    for (auto _ : bench) move(bed.state, bed.sums, still);
    report(bench, bed.state.particles.count(), move_bytes(bed.state, halves));
  });
}

void add_fold(const SettledColumn& c) {
  benchmark::RegisterBenchmark(("fold" + c.name()).c_str(), [=](benchmark::State& bench) {
    Bed& bed = settled_bed(c);
    for (auto _ : bench) fold_reactions(bed.state, bed.map(), bed.sums);
    report(bench, bed.state.particles.count(), fold_bytes(bed.state, bed.map()));
  });
}

void add_walls(const SettledColumn& c) {
  benchmark::RegisterBenchmark(("walls" + c.name()).c_str(), [=](benchmark::State& bench) {
    Bed& bed = settled_bed(c);
    const LawPasses law = bed.law(Friction::rolling);
    for (auto _ : bench) law.evaluate_walls(bed.state, bed.sums, still);
    report(bench, bed.state.particles.count(), wall_bytes(bed.state));
    bench.counters["rows_each"] = bed.state.wall_contacts.rows() / static_cast<double>(c.grains);
  });
}

void add_list(const SettledColumn& c) {
  benchmark::RegisterBenchmark(("list" + c.name()).c_str(), [=](benchmark::State& bench) {
    Bed& bed = settled_bed(c);
    for (auto _ : bench) bed.list->renew(bed.state, column_dt);  // the bed is sorted already
    report(bench, bed.state.particles.count(), not_counted);
  });
}

void add_images(long grains) {
  benchmark::RegisterBenchmark(("images/sector90/" + std::to_string(grains)).c_str(), [=](benchmark::State& bench) {
    Bed& bed = sector(grains);
    for (auto _ : bench) refresh_images(bed.state);
    report(bench, bed.state.images.count(), image_bytes(bed.state));
    bench.counters["images_per_grain"] = bed.state.images.count() / static_cast<double>(grains);
  });
}

void add_passes(const SettledColumn& c) {
  add_contacts(c, "contacts/none", Friction::none);
  add_contacts(c, "contacts/sliding", Friction::sliding);
  add_contacts(c, "contacts/rolling", Friction::rolling);
  add_fold(c);
  add_walls(c);
  add_move(c, "move/first", Halves::first);
  add_move(c, "move/second", Halves::second);
  add_move(c, "move/second_and_first", Halves::second_and_first);
  add_list(c);
}

}  // namespace
}  // namespace wedge

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: bench_passes FOLDER [--benchmark_...]\n");
    return 2;
  }
  wedge::set_thread_count(1);
  for (const long grains : {2000L, 32000L, 120000L}) {
    const std::string places = std::string(argv[1]) + "/column_" + std::to_string(grains) + ".txt";
    if (std::ifstream(places)) {
      for (const wedge::Grains kind : {wedge::Grains::alike, wedge::Grains::sizes, wedge::Grains::kinds})
        for (const wedge::Precision precision : {wedge::Precision::double_precision, wedge::Precision::mixed})
          wedge::add_passes({grains, places, kind, precision});
    } else {
      std::fprintf(stderr, "bench_passes: %s is missing (perf/run.sh makes it): %ld grains left out\n",
                   places.c_str(), grains);
    }
    wedge::add_images(grains);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
