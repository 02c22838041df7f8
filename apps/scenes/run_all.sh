#!/usr/bin/env bash
# run_all.sh FOLDER [THREADS]: runs the hopper and the sandpile, full and as sectors, into FOLDER and prints the tables
# of apps/scenes/README.md, "Runs really made". Finished runs are not repeated, interrupted ones are resumed.
# WEDGE: the program.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: bash apps/scenes/run_all.sh FOLDER [THREADS]" >&2; exit 2; }
scenes=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
wedge=${WEDGE:-$scenes/../../build/release/wedge}
[ -x "$wedge" ] || { echo "error: $wedge: no such program; build it first: bash apps/demo.sh" >&2; exit 4; }
folder=$1 threads=${2:-1} angles="360 90 60 45 30"
mkdir -p "$folder"

state_of() { sed -n 's/.*"state": "\([a-z]*\)".*/\1/p' "$1/progress.json" 2>/dev/null || true; }
for scene in hopper sandpile; do
  for angle in $angles; do
    run=$folder/${scene}_$angle
    case $(state_of "$run") in
      finished) ;;
      "") "$wedge" run "$scenes/$scene.toml" -o "$run" -j "$threads" --set "domain.angle=$angle" >"$run.log" ;;
      *) "$wedge" resume "$run" -j "$threads" >"$run.log" ;;
    esac
  done
done

# cell RUN STAGE COLUMN: a number of results/beds.csv.
cell() {
  awk -F, -v stage="$2" -v column="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == column) c = i }
    $1 == stage { print $c }' "$1/results/beds.csv"
}
# speed RUN: million grains times steps per second of wall time, all stages and files included.
speed() {
  local seconds
  seconds=$(sed -n 's/.*"wall_seconds": \([0-9.e+]*\).*/\1/p' "$1/progress.json")
  paste -d, "$1/series/energies.csv" "$1/series/ledger.csv" | awk -F, -v s="$seconds" 'NR == 1 {
      for (i = 1; i <= NF; ++i) { if ($i == "step") a = i; if ($i == "inside") b = i }; next }
    NR > 2 { sum += ($a - step) * (grains + $b) / 2 } { step = $a; grains = $b } END { printf "%.1f", sum / s / 1e6 }'
}
# common RUN: grains, wall time, speed, memory, disk as cells of a table.
common() {
  printf '%d | %s | %s | %s | %s' "$(awk -F, 'NR == 2 { print $2 }' "$1/series/ledger.csv")" \
    "$(sed -n 's/.*"wall_seconds": \([0-9.e+]*\).*/\1/p' "$1/progress.json" |
      awk '{ printf "%d:%02d", $1 / 60, $1 % 60 }')" \
    "$(speed "$1")" "$(sed -n 's/.*peak memory \([0-9]*\) MB.*/\1/p' "$1.log")" "$(du -sm "$1" | cut -f 1)"
}
# residual RUN: of the energy budget, in per cent of what was dissipated.
residual() {
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) { split($i, n, " "); c[n[1]] = i } }
    END { printf "%.2f", 100 * $c["residual"] / ($c["normal_damping"] + $c["tangential_damping"] + $c["sliding"] + $c["rolling"] + $c["axis"]) }' \
    "$1/series/energies.csv"
}
name() { if [ "$1" = 360 ]; then echo full; else echo "$1°"; fi; }

echo "| sector | grains | wall time | million steps/s | memory [MB] | disk [MB] | packing | CN | grains out | rate [1/s] | residual [%] |"
echo "|---|---|---|---|---|---|---|---|---|---|---|"
for angle in $angles; do
  run=$folder/hopper_$angle
  printf '| %s | %s | %.3f | %.2f | %.0f | %.0f | %s |\n' "$(name "$angle")" "$(common "$run")" \
    "$(cell "$run" settle packing)" "$(cell "$run" settle cn)" \
    "$(cell "$run" discharge grains_discharged)" "$(cell "$run" discharge "discharge_rate [1/s]")" "$(residual "$run")"
done
echo
echo "| sector | grains | wall time | million steps/s | memory [MB] | disk [MB] | grains left | CN | angle of repose [deg] | residual [%] |"
echo "|---|---|---|---|---|---|---|---|---|---|"
for angle in $angles; do
  run=$folder/sandpile_$angle
  printf '| %s | %s | %.0f | %.2f | %.1f | %s |\n' "$(name "$angle")" "$(common "$run")" \
    "$(cell "$run" collapse grains)" "$(cell "$run" collapse cn)" \
    "$(cell "$run" collapse "angle_of_repose [deg]")" "$(residual "$run")"
done
