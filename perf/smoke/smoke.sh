#!/usr/bin/env bash
# smoke.sh [--record]: is the step still as fast and does it still compute the same, by counts, not by seconds?
#   1. instructions per particle-step, counted by valgrind, at most 5 % above the recorded ones;
#   2. double arithmetic of the hot loops is packed: the object code is looked at;
#   3. the signature, a hash of a fixed small run, is the recorded one, with one thread and with two.
# Built for x86-64-v3, because valgrind 3.19 does not know AVX-512. --record writes the numbers of now into
# perf/smoke/smoke_counts.txt; they hold for one compiler and C library, others are told so and not compared.
# Ends with 0 when all is well, 1 when a check fails, 77 when something is missing here (ctest: skipped).
set -euo pipefail
shopt -s inherit_errexit
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. apps/setup/install_needed.sh
case "$#${1:-}" in 0 | 1--record) mode=${1:-compare} ;; *) echo "usage: bash perf/smoke/smoke.sh [--record]" >&2; exit 2 ;; esac
recorded=perf/smoke/smoke_counts.txt folder=build/smoke grains=2000 allowed=5  # per cent
bench=$folder/perf/bench_step
export OMP_NUM_THREADS=1

skip() {
  echo "perf smoke skipped: $1"
  exit 77
}
failures=0
fail() {
  echo "perf smoke FAILED: $1" >&2
  failures=$((failures + 1))
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

# arithmetic SYMBOLS: packed and scalar instructions on doubles and floats in the functions whose names match.
arithmetic() {
  awk -v symbols="$1" '
    /^[0-9a-f]+ <.*>:$/ { inside = $0 ~ symbols; functions += inside; next }
    !inside { next }
    /\tv(add|sub|mul|div|sqrt|max|min|fn?m(add|sub)(132|213|231))p[ds] .*%ymm/ { ++packed }
    /\tv(add|sub|mul|div|sqrt|max|min|fn?m(add|sub)(132|213|231))s[ds] / { ++scalar }
    END { print functions + 0, packed + 0, scalar + 0 }' "$folder/code.txt"
}

# check_packed NAME LEAST SYMBOLS: packed instructions must be LEAST times the scalar ones.
check_packed() {
  local functions packed scalar
  read -r functions packed scalar < <(arithmetic "$3")
  echo "$1: $packed packed and $scalar scalar arithmetic instructions, in $functions functions"
  [ "$functions" -gt 0 ] || { fail "$1: no such function any more; name the new one in perf/smoke/smoke.sh"; return; }
  awk -v p="$packed" -v s="$scalar" -v least="$2" 'BEGIN { exit !(p > 0 && p >= least * s) }' ||
    fail "$1: not vectorised: $packed packed against $scalar scalar instructions (least ratio $2)"
}

# The hot functions of the default scene: Mindlin-Deresiewicz, rolling (Friction 2), energy budget, grains alike.
check_loops() {
  local law='wedge::MindlinDeresiewicz' rolling='\\(wedge::Friction\\)2' no_axis='\\(wedge::AxisAction\\)0'
  objdump -d --no-show-raw-insn -C "$bench" >"$folder/code.txt"
  local number mix
  for number in double float; do
    mix="wedge::UniformMix<$law, $number>"
    check_packed "contacts, $number" 5 "<(void )?wedge::(TilePass<$law, $rolling, true, $mix|respond<$law, $rolling, true, $mix|approach<$rolling, $mix)"
    check_packed "sums of contacts, $number" 5 "<(void )?wedge::add_to_sums<true, $number>"
    check_packed "walls, $number" 5 "<wedge::WallPass<$law, $rolling, $number>::respond"
    # Each operation stands there twice: the last grains of a block are moved one by one.
    check_packed "grains moved, $number" 0.6 "<wedge::MovePass<[^,]*, $rolling, $no_axis, $number, wedge::UniformBodies>::move"
  done
}

# record_of NAME: what is recorded under this name.
record_of() { awk -v name="$1" '$1 == name { $1 = ""; print substr($0, 2) }' "$recorded"; }

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
toolchain="$(g++ --version | head -n 1), $(getconf GNU_LIBC_VERSION)"
[ "$mode" = --record ] || [ -s "$recorded" ] || { echo "error: $recorded is missing: bash perf/smoke/smoke.sh --record" >&2; exit 1; }

# A folder made for another compiler is made anew: told of a new one, CMake would forget all other options.
[ ! -f "$folder/CMakeCache.txt" ] ||
  [ "$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$folder/CMakeCache.txt")" = "$(command -v g++)" ] || rm -rf "$folder"
CXX=$(command -v g++) configure "$folder" -DCMAKE_BUILD_TYPE=Release -DWEDGE_NATIVE=OFF \
  -DCMAKE_CXX_FLAGS=-march=x86-64-v3 -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON >/dev/null
cmake --build "$folder" -j 1 --target bench_step >"$folder/build.log" ||  # one job: ctest runs others beside it
  { tail -n 40 "$folder/build.log" >&2; exit 1; }

# signature_of PRECISION THREADS
signature_of() { "$bench" --signature --precision "$1" --threads "$2" | awk '/^signature/ { print $2 }'; }
signature=$(signature_of double 1) signature_mixed=$(signature_of mixed 1)
echo "signature $signature, mixed precision $signature_mixed"
[ -n "$signature" ] && [ "$signature" = "$(signature_of double 2)" ] || fail "signature $signature is another with two threads"
[ -n "$signature_mixed" ] && [ "$signature_mixed" = "$(signature_of mixed 2)" ] ||
  fail "signature $signature_mixed, of mixed precision, is another with two threads"
check_loops
"$bench" --particles $grains --settle 0.3 --steps 1 --write "$folder/settled.txt" >/dev/null
settled=$(per_particle_step --start "$folder/settled.txt" --settle 0.002)
mixed=$(per_particle_step --start "$folder/settled.txt" --settle 0.002 --precision mixed)
falling=$(per_particle_step --settle 0.005)
echo "instructions per particle-step: $settled in a settled bed, $mixed in mixed precision, $falling in a falling bed, where lists are made"

if [ "$mode" = --record ]; then
  [ $failures -eq 0 ] || { echo "error: nothing recorded" >&2; exit 1; }
  {
    echo "# Written by perf/smoke/smoke.sh --record; compared by perf/smoke/smoke.sh where the toolchain is this one."
    echo "# settled, mixed, falling: instructions per particle-step of $grains grains, built for x86-64-v3."
    printf '%s\n' "toolchain $toolchain" "settled $settled" "mixed $mixed" "falling $falling" "signature $signature" \
      "signature_mixed $signature_mixed"
  } >"$recorded"
  echo "recorded in $recorded"
elif [ "$toolchain" != "$(record_of toolchain)" ]; then
  echo "counts and signature NOT COMPARED: recorded with $(record_of toolchain), this is $toolchain"
else
  compare_count settled "$settled"
  compare_count mixed "$mixed"
  compare_count falling "$falling"
  for name in signature signature_mixed; do
    [ "${!name}" = "$(record_of $name)" ] ||
      fail "$name ${!name}, recorded is $(record_of $name): a commit that changes results must record the new one by bash perf/smoke/smoke.sh --record and say 'Signature: ${!name}' in its message"
  done
fi
[ $failures -eq 0 ] || exit 1
echo "perf smoke passed"
