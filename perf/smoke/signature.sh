#!/usr/bin/env bash
# signature.sh BENCH_STEP: does this build of the step compute what it did, and in packs?
#   1. The signature, a hash of a fixed small run, is the recorded one, in both precisions, with one thread and with two.
#   2. Arithmetic of the hot loops is packed: the object code is looked at.
# The record, perf/smoke/smoke_counts.txt, holds for one compiler and C library, but for any processor; others are told
# so and not compared. Ends with 0 when all is well, 1 when a check fails, 77 when something is missing (ctest: skipped).
set -euo pipefail
shopt -s inherit_errexit
[ $# -eq 1 ] && [ -x "$1" ] || { echo "usage: bash perf/smoke/signature.sh BENCH_STEP" >&2; exit 2; }
bench=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. perf/smoke/record.sh
for tool in g++ objdump; do command -v $tool >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }; done
code=$(mktemp)
trap 'rm -f "$code"' EXIT

# arithmetic SYMBOLS: packed and scalar instructions on doubles and floats in the functions whose names match.
arithmetic() {
  awk -v symbols="$1" '
    /^[0-9a-f]+ <.*>:$/ { inside = $0 ~ symbols; functions += inside; next }
    !inside { next }
    /\tv(add|sub|mul|div|sqrt|max|min|fn?m(add|sub)(132|213|231))p[ds] .*%[yz]mm/ { ++packed }
    /\tv(add|sub|mul|div|sqrt|max|min|fn?m(add|sub)(132|213|231))s[ds] / { ++scalar }
    END { print functions + 0, packed + 0, scalar + 0 }' "$code"
}

# check_packed NAME LEAST SYMBOLS: packed instructions must be LEAST times the scalar ones.
check_packed() {
  local functions packed scalar
  read -r functions packed scalar < <(arithmetic "$3")
  echo "$1: $packed packed and $scalar scalar arithmetic instructions, in $functions functions"
  [ "$functions" -gt 0 ] || { fail "$1: no such function any more; name the new one in perf/smoke/signature.sh"; return; }
  awk -v p="$packed" -v s="$scalar" -v least="$2" 'BEGIN { exit !(p > 0 && p >= least * s) }' ||
    fail "$1: not vectorised: $packed packed against $scalar scalar instructions (least ratio $2)"
}

# The hot functions of the default scene: Mindlin-Deresiewicz, rolling (Friction 2), energy budget, grains alike.
check_loops() {
  local law='wedge::MindlinDeresiewicz' rolling='\\(wedge::Friction\\)2' no_axis='\\(wedge::AxisAction\\)0'
  local number mix
  objdump -d --no-show-raw-insn -C "$bench" >"$code"
  check_packed "walls" 5 "<wedge::WallPass<$law, $rolling>::respond"
  # Each operation stands there twice: the last grains of a block are moved one by one.
  check_packed "grains moved" 0.6 "<wedge::MovePass<[^,]*, $rolling, $no_axis, wedge::UniformBodies>::move"
  for number in double float; do
    mix="wedge::UniformMix<$law, $number>"
    check_packed "contacts, $number" 5 "<(void )?wedge::(TilePass<$law, $rolling, true, $mix|respond<$law, $rolling, true, $mix)"
    check_packed "their geometry, $number" 5 "<void wedge::approach<$rolling, true, $number>"
    check_packed "sums of contacts, $number" 5 "<void wedge::add_to_sums<true, $number>"
  done
}

check_signatures() {
  local name precision now
  for name in signature signature_mixed; do
    precision=double
    [ $name = signature ] || precision=mixed
    now=$(signature_of "$bench" $precision 1)
    echo "$name $now"
    [ -n "$now" ] && [ "$now" = "$(signature_of "$bench" $precision 2)" ] || fail "$name $now is another with two threads"
    same_toolchain || continue
    [ "$now" = "$(record_of $name)" ] ||
      fail "$name $now, recorded is $(record_of $name): a commit that changes results must record the new one by bash perf/smoke/smoke.sh --record and say 'Signature: $now' in its message"
  done
  same_toolchain || echo "signature NOT COMPARED: recorded with $(record_of toolchain), this is $toolchain"
}

check_signatures
check_loops
[ $failures -eq 0 ] || exit 1
echo "signature and packed loops: passed"
