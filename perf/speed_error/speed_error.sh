#!/usr/bin/env bash
# speed_error.sh [--quick] [--fresh] [--page-only]: how do speed and error trade in the time step, the stiffness, the skin,
# the precision and the angle of a sector? Builds speed_error, runs what is not yet in build/speed_error, and writes
# speed_error.md and speed_error.svg beside this script: some 10 minutes of computing, one thread. A stopped command goes
# on where it was; a change of the code that is measured starts anew, and so does --fresh. --quick is a smoke test of
# about a minute, with smaller beds and two seeds; it writes build/speed_error/quick.md and quick.svg. --page-only runs
# nothing: it writes the page of what there is. What stands by hand at the end of the page is kept.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. apps/setup/install_needed.sh
quick=() only=() fresh=no page=perf/speed_error
for word in "$@"; do
  case "$word" in
    --quick) quick=(--quick) page=build/speed_error/quick ;;
    --fresh) fresh=yes ;;
    --page-only) only=(--page-only) ;;
    *) echo "usage: bash perf/speed_error/speed_error.sh [--quick] [--fresh] [--page-only]" >&2; exit 2 ;;
  esac
done

install_needed
configure build/release -DCMAKE_BUILD_TYPE=Release -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON >/dev/null
cmake --build build/release -j "$(nproc)" --target speed_error

# Results belong to the code and the scenes that made them.
key=$(cat core/*.[ch]pp kernels/*.[ch]pp perf/speed_error/runs.cpp perf/speed_error/impacts.cpp apps/run/bed_table.cpp \
  apps/scenes/hopper_small.toml apps/scenes/sandpile.toml | sha1sum | cut -c 1-10)
results=build/speed_error/$key${quick:+-quick}
[ "$fresh" = no ] || rm -rf "$results"
commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
machine=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
build/release/perf/speed_error "${quick[@]}" "${only[@]}" --results "$results" --page "$page" \
  --origin "commit $commit, one thread, $machine, $(g++ --version | head -n 1)"
