// bench_limits.cpp: what can one core of this machine do at most: bytes from each level of memory, and double
// arithmetic in packs? Needs Google Benchmark.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/array.hpp"
#include "core/pack.hpp"

namespace wedge {
namespace {

using benchmark::Counter;

/// Arrays of a working set, each a whole number of strides.
struct WorkingSet {
  Array<double> a, b, c;
  Index count = 0;

  /// `arrays` of them share the bytes.
  WorkingSet(double bytes, int arrays) {
    count = static_cast<Index>(bytes / (sizeof(double) * static_cast<double>(arrays))) / stride * stride;
    const auto n = static_cast<std::size_t>(count);
    a.assign(n, 1.5);
    if (arrays > 1) b.assign(n, 2.5);
    if (arrays > 2) c.assign(n, 0.5);
  }
  static constexpr Index chains = 8;  // independent sums: an addition takes longer than a load
  static constexpr Index stride = chains * pack_size;
};

/// Bytes read and written by the program. A line that is fetched only to be overwritten is not counted.
void report_bytes(benchmark::State& bench, const WorkingSet& set, int arrays) {
  bench.counters["bytes"] =
      Counter(static_cast<double>(sizeof(double)) * arrays * set.count, Counter::kIsIterationInvariantRate);
}

void read(benchmark::State& bench, double bytes) {
  const WorkingSet set(bytes, 1);
  Pack sum[WorkingSet::chains] = {};
  for (auto _ : bench) {
    for (Index i = 0; i < set.count; i += WorkingSet::stride)
      for (Index k = 0; k < WorkingSet::chains; ++k) sum[k] += load(set.a.data() + i + k * pack_size);
    benchmark::ClobberMemory();
  }
  for (Pack& s : sum) benchmark::DoNotOptimize(s);
  report_bytes(bench, set, 1);
}

void copy(benchmark::State& bench, double bytes) {
  WorkingSet set(bytes, 2);
  for (auto _ : bench) {
    for (Index i = 0; i < set.count; i += pack_size) store(set.a.data() + i, load(set.b.data() + i));
    benchmark::ClobberMemory();
  }
  report_bytes(bench, set, 2);
}

/// a = b + 3 c, of STREAM (McCalpin 1995).
void triad(benchmark::State& bench, double bytes) {
  WorkingSet set(bytes, 3);
  for (auto _ : bench) {
    for (Index i = 0; i < set.count; i += pack_size)
      store(set.a.data() + i, load(set.b.data() + i) + 3.0 * load(set.c.data() + i));
    benchmark::ClobberMemory();
  }
  report_bytes(bench, set, 3);
}

/// An operation on numbers of the nearest cache, each result added to one of several sums: the additions overlap
/// with operations that take longer. `flops`: of the operation and the addition, for one number.
template <class Number, class Operation>
void compute(benchmark::State& bench, int flops, Operation operation) {
  using Real = PackOf<Number>;
  constexpr Index size = lanes<Number>, count = 64 * WorkingSet::stride / pack_size;  // 4 kB in packs of eight
  Array<Number> numbers(static_cast<std::size_t>(count * size));
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 1 + 1 / (Number(3) + static_cast<Number>(i));
  Real sum[WorkingSet::chains] = {};
  for (auto _ : bench) {
    for (Index i = 0; i < count; i += WorkingSet::chains)
      for (Index k = 0; k < WorkingSet::chains; ++k)
        sum[k] = operation(sum[k], Real(numbers.data() + (i + k) * size, simd::element_aligned));
    benchmark::ClobberMemory();
  }
  for (Real& s : sum) benchmark::DoNotOptimize(s);
  const double operations = static_cast<double>(count) * size;
  bench.counters["numbers"] = Counter(operations, Counter::kIsIterationInvariantRate);
  bench.counters["flops"] = Counter(flops * operations, Counter::kIsIterationInvariantRate);
}

template <class Number>
void add_arithmetic(const std::string& width) {
  const auto add = [](const auto& sum, const auto& x) { return sum + x; };
  const auto multiply_add = [](const auto& sum, const auto& x) { return sum * constant<decltype(x + x)>(0.5) + x; };
  const auto divide = [](const auto& sum, const auto& x) { return sum + 1 / x; };
  const auto root = [](const auto& sum, const auto& x) { return sum + simd::sqrt(x); };
  const auto enter = [&](const char* name, int flops, auto operation) {
    benchmark::RegisterBenchmark(("arithmetic/" + std::string(name) + width).c_str(),
                                 [=](benchmark::State& b) { compute<Number>(b, flops, operation); });
  };
  enter("add", 1, add);
  enter("multiply_add", 2, multiply_add);
  enter("divide_and_add", 2, divide);
  enter("root_and_add", 2, root);
}

void add_bandwidth(const std::string& level, double bytes) {
  using benchmark::RegisterBenchmark;
  RegisterBenchmark(("read/" + level).c_str(), [=](benchmark::State& b) { read(b, bytes); });
  RegisterBenchmark(("copy/" + level).c_str(), [=](benchmark::State& b) { copy(b, bytes); });
  RegisterBenchmark(("triad/" + level).c_str(), [=](benchmark::State& b) { triad(b, bytes); });
}

/// Working sets of half of each cache; an eighth of the last one, which is shared, but twice what the one below it
/// holds; and four times the last one, at least 256 MB and at most 1 GB, for memory.
void add_levels() {
  double below = 0, largest = 0;
  std::vector<std::pair<int, double>> caches;
  for (const auto& cache : benchmark::CPUInfo::Get().caches)
    if (cache.type != "Instruction") caches.emplace_back(cache.level, cache.size);
  std::sort(caches.begin(), caches.end());
  for (const auto& [level, size] : caches) {
    const double bytes = level < 3 ? 0.5 * size : std::max(0.125 * size, 2 * below);
    add_bandwidth("L" + std::to_string(level) + "_" + std::to_string(static_cast<long>(bytes) >> 10) + "kB", bytes);
    below = largest = size;
  }
  const double bytes = std::clamp(4 * largest, 256e6, 1e9);
  add_bandwidth("memory_" + std::to_string(static_cast<long>(bytes / 1e6)) + "MB", bytes);
}

}  // namespace
}  // namespace wedge

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  wedge::add_levels();
  wedge::add_arithmetic<double>("");
  wedge::add_arithmetic<float>("_float");
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
