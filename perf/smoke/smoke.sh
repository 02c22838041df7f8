#!/usr/bin/env bash
# smoke.sh [--record]: is the step still as fast, by counts, not by seconds? Instructions per particle-step, counted by
# valgrind, are at most 5 % above the recorded ones; and what signature.sh checks holds.
# Built for x86-64-v3, because valgrind 3.19 does not know AVX-512. --record writes the numbers of now into
# perf/smoke/smoke_counts.txt; they hold for one compiler and C library, others are told so and not compared.
# Ends with 0 when all is well, 1 when a check fails, 77 when something is missing here (ctest: skipped).
set -euo pipefail
shopt -s inherit_errexit
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. apps/setup/install_needed.sh
. perf/smoke/record.sh
case "$#${1:-}" in 0 | 1--record) mode=${1:-compare} ;; *) echo "usage: bash perf/smoke/smoke.sh [--record]" >&2; exit 2 ;; esac
folder=build/smoke grains=2000 allowed=5  # per cent
bench=$folder/perf/bench_step

skip() {
  echo "perf smoke skipped: $1"
  exit 77
}

# instructions OPTION...: executed by bench_step, all in all.
instructions() {
  local log=$folder/valgrind.log
  valgrind --tool=exp-bbv --instr-count-only=yes --bb-out-file=/dev/null --log-file="$log" "$bench" --particles $grains "$@" \
    >"$folder/valgrind.out" || { echo "error: bench_step failed under valgrind: see $log" >&2; return 1; }
  awk '/Total instructions:/ { n += $NF } END { printf "%.0f\n", n; exit !n }' "$log"  # a line for each thread
}

# per_particle_step OPTION...: instructions of the time loop alone: a long run less a short one, the same until there.
per_particle_step() {
  local short long windows=5 fewer=20 more=60
  short=$(instructions "$@" --steps $fewer)
  long=$(instructions "$@" --steps $more)
  awk -v a="$short" -v b="$long" -v n=$((windows * (more - fewer) * grains)) 'BEGIN { printf "%.1f\n", (b - a) / n }'
}

# compare_count NAME NOW
compare_count() {
  local before
  before=$(record_of "$1")
  awk -v a="$before" -v b="$2" -v most=$allowed 'BEGIN { exit !(a > 0 && b <= a * (1 + most / 100)) }' ||
    fail "$1: $2 instructions per particle-step, more than $allowed % above the recorded $before"
  awk -v a="$before" -v b="$2" -v most=$allowed 'BEGIN { exit !(b < a * (1 - most / 100)) }' &&
    echo "$1: more than $allowed % below the recorded $before: record it by bash perf/smoke/smoke.sh --record" || true
}

[ "$(uname -m)" = x86_64 ] && grep -qw avx2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo ||
  skip "this processor does not run code for x86-64-v3"
for tool in g++ valgrind objdump; do command -v $tool >/dev/null || skip "$tool is not installed"; done
[ "$mode" = --record ] || [ -s "$recorded" ] || { echo "error: $recorded is missing: bash perf/smoke/smoke.sh --record" >&2; exit 1; }

# A folder made for another compiler is made anew: told of a new one, CMake would forget all other options.
[ ! -f "$folder/CMakeCache.txt" ] ||
  [ "$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$folder/CMakeCache.txt")" = "$(command -v g++)" ] || rm -rf "$folder"
CXX=$(command -v g++) configure "$folder" -DCMAKE_BUILD_TYPE=Release -DWEDGE_NATIVE=OFF \
  -DCMAKE_CXX_FLAGS=-march=x86-64-v3 -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON >/dev/null
cmake --build "$folder" -j "$(nproc)" --target bench_step >"$folder/build.log" ||
  { tail -n 40 "$folder/build.log" >&2; exit 1; }

"$bench" --particles $grains --settle 0.3 --steps 1 --write "$folder/settled.txt" >/dev/null
settled=$(per_particle_step --start "$folder/settled.txt" --settle 0.002)
mixed=$(per_particle_step --start "$folder/settled.txt" --settle 0.002 --precision mixed)
falling=$(per_particle_step --settle 0.005)
echo "instructions per particle-step: $settled in a settled bed, $mixed in mixed precision, $falling in a falling bed, where lists are made"

if [ "$mode" = --record ]; then
  {
    echo "# Written by perf/smoke/smoke.sh --record; compared where the toolchain is this one."
    echo "# settled, mixed, falling: instructions per particle-step of $grains grains, built for x86-64-v3."
    printf '%s\n' "toolchain $toolchain" "settled $settled" "mixed $mixed" "falling $falling" \
      "signature $(signature_of "$bench" double 1)" "signature_mixed $(signature_of "$bench" mixed 1)"
  } >"$recorded"
  echo "recorded in $recorded"
elif same_toolchain; then
  compare_count settled "$settled"
  compare_count mixed "$mixed"
  compare_count falling "$falling"
else
  echo "counts NOT COMPARED: recorded with $(record_of toolchain), this is $toolchain"
fi
bash perf/smoke/signature.sh "$bench" || failures=$((failures + 1))
[ $failures -eq 0 ] || exit 1
echo "perf smoke passed"
