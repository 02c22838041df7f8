#!/usr/bin/env bash
# run.sh [GRAINS [ROUNDS]]: how fast is the settled column (32000 grains, 5 rounds), and how fast are LAMMPS and LIGGGHTS
# on the same places, where they are installed (Debian: lammps, liggghts)? Builds bench_step, settles the column once,
# then runs all in turn, one core each, so that a machine whose speed drifts drifts for all. Prints medians and ratios.
# Then what the machine can do at most, what each pass costs, and the one over the other, by Google Benchmark (Debian:
# libbenchmark-dev).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup/install_needed.sh
grains=${1:-32000} rounds=${2:-5} steps=400
case "$grains$rounds" in *[!0-9]*) echo "usage: bash perf/run.sh [GRAINS [ROUNDS]]" >&2; exit 2 ;; esac

install_needed libbenchmark-dev
configure build/release -DCMAKE_BUILD_TYPE=Release -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON
cmake --build build/release -j "$(nproc)" --target bench_step
bench=build/release/perf/bench_step folder=build/perf
mkdir -p "$folder"
# settle GRAINS: makes the file of their settled places, once.
settle() {
  local places=$folder/column_$1.txt
  [ ! -s "$places" ] || return 0
  echo "settling $1 grains, once"
  $bench --particles "$1" --settle 1 --steps 1 --threads "$(nproc)" --write "$places.part" >/dev/null
  mv "$places.part" "$places"
}
places=$folder/column_$grains.txt data=$folder/column_$grains.data
settle "$grains"
awk -v n="$grains" '{ line[NR] = NR " 1 0.005 3800 " $0; if ($3 > top) top = $3 } END {
  printf "column of perf/run.sh\n\n%d atoms\n1 atom types\n\n-0.102 0.102 xlo xhi\n-0.102 0.102 ylo yhi\n-0.02 %g zlo zhi\n\nAtoms\n\n", n, top + 0.02
  for (i = 1; i <= NR; ++i) print line[i] }' "$places" >"$data"

# Each prints million particle-steps per second.
ours() { $bench --particles "$grains" --start "$places" --settle 0.02 --steps $((steps / 5)) "$@" | awk '/^particle_steps_per_second/ { print $2 / 1e6 }'; }
loop_time() { awk '/^Loop time of/ { s = $4; k = $9; n = $12 } END { print k * n / s / 1e6 }'; }
lammps() { OMP_NUM_THREADS=1 lmp -log none -in perf/peers/column.lmp -var data "$data" -var law "$1" -var warm 200 -var steps $steps | loop_time; }
liggghts_cdt() { liggghts -log none -in perf/peers/column.liggghts -var data "$data" -var warm 200 -var steps $steps | loop_time; }

names=("wedge, rolling friction" "wedge, no rolling friction" "wedge, mixed precision, rolling friction")
commands=("ours --rolling on" "ours --rolling off" "ours --rolling on --precision mixed")
if command -v lmp >/dev/null; then
  names+=("LAMMPS gran/hertz/history, no rolling" "LAMMPS granular, rolling sds")
  commands+=("lammps history" "lammps sds")
fi
if command -v liggghts >/dev/null; then
  names+=("LIGGGHTS hertz history, rolling cdt")
  commands+=("liggghts_cdt")
fi
results=$(mktemp)
trap 'rm -f "$results"' EXIT
for round in $(seq "$rounds"); do
  for c in "${!commands[@]}"; do printf '%s\t%s\t%s\n' "$c" "$round" "$(${commands[c]})" >>"$results"; done
done

# column K: the numbers of command K, ascending.
column() { awk -v c="$1" '$1 == c { print $3 }' "$results" | sort -g; }
median() { awk '{ x[NR] = $1 } END { print NR % 2 ? x[(NR + 1) / 2] : (x[NR / 2] + x[NR / 2 + 1]) / 2 }'; }
# ratio A B: the median over the rounds of A over B.
ratio() { awk -v a="$1" -v b="$2" '$1 == a { x[$2] = $3 } $1 == b { y[$2] = $3 } END { for (r in x) print x[r] / y[r] }' "$results" | sort -g | median; }

echo
echo "$grains grains, one core, $rounds rounds: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(g++ --version | head -n 1)"
echo
echo "| code | million particle-steps/s: median | least | most | wedge (rolling) over it | wedge (no rolling) over it |"
echo "|---|---|---|---|---|---|"
for c in "${!commands[@]}"; do
  printf '| %s | %.2f | %.2f | %.2f | %.2f | %.2f |\n' "${names[c]}" "$(column "$c" | median)" "$(column "$c" | head -n 1)" \
    "$(column "$c" | tail -n 1)" "$(ratio 0 "$c")" "$(ratio 1 "$c")"
done

# medians NAME PROGRAM OPTION...: of three repetitions; all in the file NAME.json.
medians() {
  local out=$folder/$1.json
  shift
  "$@" --benchmark_repetitions=3 --benchmark_min_time=0.2 --benchmark_display_aggregates_only=true --benchmark_counters_tabular=true \
    --benchmark_out="$out" --benchmark_out_format=json | grep -vE '_(mean|stddev|cv) '
}
echo
if ! cmake --build build/release --target help | grep bench_passes >/dev/null; then
  echo "Google Benchmark is not installed: no tables of the machine's limits and of the passes"
  exit 0
fi
cmake --build build/release -j "$(nproc)" --target bench_limits bench_passes
for size in 2000 32000 120000; do settle $size; done  # the largest takes some minutes
medians limits build/release/perf/bench_limits
medians passes build/release/perf/bench_passes "$folder"
echo
awk -f perf/bench/bound.awk "$folder/limits.json" "$folder/passes.json"
