#!/usr/bin/env bash
# speed_error.sh [--quick] [--fresh] [--page-only]: how do speed and error trade in the time step, the stiffness, the
# skin, the precision and the angle of a sector? Builds speed_error, runs what is not yet in build/speed_error (some 10
# minutes of computing, one thread) and writes speed_error.md and speed_error.svg beside this script; what stands by
# hand at the end of the page is kept.
#   --quick      a smoke test of about a minute, with smaller beds and two seeds; the page is build/speed_error/quick.md
#   --fresh      forgets what was run. Otherwise a stopped command goes on where it was, unless the code has changed.
#   --page-only  runs nothing: the page of what there is
# The page needs numpy and matplotlib. WEDGE_PYTHON: the interpreter, else that of PATH or that of the system.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. apps/setup/install_needed.sh
quick=() run=yes fresh=no page=perf/speed_error/speed_error
for word in "$@"; do
  case "$word" in
    --quick) quick=(--quick) page=build/speed_error/quick ;;
    --fresh) fresh=yes ;;
    --page-only) run=no ;;
    *) echo "usage: bash perf/speed_error/speed_error.sh [--quick] [--fresh] [--page-only]" >&2; exit 2 ;;
  esac
done

install_needed python3-matplotlib python3-numpy
for python in ${WEDGE_PYTHON:-python3 /usr/bin/python3} ""; do
  [ -n "$python" ] || { echo "error: no Python with numpy and matplotlib" >&2; exit 1; }
  ! "$python" -B -c "import numpy, matplotlib" 2>/dev/null || break
done

# Results belong to the code and the scenes that made them.
key=$({ find core kernels apps/measure apps/setup apps/run -name '*.[ch]pp'
  ls apps/scenes/{hopper_small,sandpile}.toml perf/speed_error/{runs,impacts}.cpp; } |
  LC_ALL=C sort | xargs cat | sha1sum | cut -c 1-10)
results=build/speed_error/$key${quick:+-quick}
[ "$fresh" = no ] || rm -rf "$results"
if [ "$run" = yes ]; then
  configure build/release -DCMAKE_BUILD_TYPE=Release -DWEDGE_TESTS=OFF -DWEDGE_PERF=ON >/dev/null
  cmake --build build/release -j "$(nproc)" --target speed_error
  build/release/perf/speed_error "${quick[@]}" "$results"
fi
commit=$(git rev-parse --short HEAD 2>/dev/null || echo unknown)
machine=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
"$python" -B perf/speed_error/page.py "${quick[@]}" "$results" "$page" \
  "commit $commit, one thread, $machine, $(g++ --version | head -n 1)"
