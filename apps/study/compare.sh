#!/usr/bin/env bash
# compare.sh RUNS COMPARISONS: compares the sectors in the folder RUNS with the full vessels of their set, and writes a
# table for each pair of ensembles into COMPARISONS. WEDGE: the program.
set -euo pipefail
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
wedge=${WEDGE:-$study/../../build/release/wedge}
[ -x "$wedge" ] || { echo "error: $wedge: no such program; build it first: bash apps/demo.sh" >&2; exit 4; }
[ $# -eq 2 ] || { echo "usage: bash apps/study/compare.sh RUNS COMPARISONS" >&2; exit 2; }
runs=$1 comparisons=$2
mkdir -p "$comparisons"
others=$(find "$comparisons" -mindepth 1 ! -name '*.csv' | head -n 1)
[ -z "$others" ] || { echo "error: $comparisons holds more than comparisons: $others" >&2; exit 2; }
rm -f "$comparisons"/*.csv
comparisons=$(cd "$comparisons" && pwd)
cd "$runs"

# compared NAME REFERENCE WITH: sets of runs as patterns; nothing where one is empty.
compared() {
  local reference with
  mapfile -t reference < <(compgen -G "$2" | sort -V)
  mapfile -t with < <(compgen -G "$3" | sort -V)
  [ ${#reference[@]} -gt 0 ] && [ ${#with[@]} -gt 0 ] || return 0
  "$wedge" compare "${reference[@]}" --with "${with[@]}" --csv "$comparisons/$1.csv" >/dev/null
  echo "$1: ${#reference[@]} full, ${#with[@]} compared"
}

for set in pile hopper20 hopper40 small_hopper small_pile; do
  for angle in 90 60 45 30; do compared "${set}_a$angle" "$set/a360_s*" "$set/a${angle}_s*"; done
done
for bound in rigid frictionless images pin line; do
  for angle in 90 45; do compared "sides_a${angle}_$bound" "hopper20/a360_s*" "sides/a${angle}_${bound}_s*"; done
done
compared sides_slot "hopper20/a360_s*" "sides/slot_s*"
for vessel in w20_o8 w30_o8 w40_o6 w40_o8 w40_o10 w40_o12 w60_o8; do
  for angle in 180 120 90 72 60 45 36 30 24 20 15; do
    compared "angle_${vessel}_a$angle" "angle/${vessel}_a360_s*" "angle/${vessel}_a${angle}_s*"
  done
done
