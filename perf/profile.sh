#!/usr/bin/env bash
# profile.sh [BENCH_STEP OPTION...]: where does the time of a step go? First the share of each pass by the program's own
# clock, then the functions: sampled by perf where it can sample, else counted in instructions by valgrind's callgrind (in
# a build for x86-64-v3: valgrind 3.19 does not know AVX-512). Without options: 8000 grains of the settled column.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup/install_needed.sh
[ $# -gt 0 ] || set -- --particles 8000 --settle 0.3 --steps 200
build() {
  configure "$1" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON "${@:2}"
  cmake --build "$1" -j "$(nproc)" --target bench_step
}

install_needed
if command -v perf >/dev/null && perf record -e cpu-clock -o /dev/null true >/dev/null 2>&1; then
  build build/profile
  samples=$(mktemp)
  trap 'rm -f "$samples"' EXIT
  perf record -e cpu-clock -F 2000 -o "$samples" build/profile/perf/bench_step "$@"
  perf report -i "$samples" --stdio --no-children --percent-limit 0.5 2>/dev/null | grep -v '^#' | grep -v '^$'
else
  command -v valgrind >/dev/null || { echo "error: neither perf can sample here nor is there valgrind; install one" >&2; exit 1; }
  build build/profile-v3 -DWEDGE_NATIVE=OFF -DCMAKE_CXX_FLAGS=-march=x86-64-v3
  build/profile-v3/perf/bench_step "$@"
  counts=$(mktemp)
  trap 'rm -f "$counts"' EXIT
  valgrind --tool=callgrind --callgrind-out-file="$counts" build/profile-v3/perf/bench_step "$@" >/dev/null
  callgrind_annotate --threshold=99 "$counts" | head -n 40
fi
