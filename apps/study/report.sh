#!/usr/bin/env bash
# report.sh [--small]: builds wedge, unpacks the runs kept in data/ beside this file to build/study/runs, and makes the
# page of the study from them: build/study/report.html. With --small it makes two seeds of a small hopper and a small
# sandpile, full and as sectors, and the page from these: build/study/small/report.html.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. apps/setup/install_needed.sh

[ $# -eq 0 ] || [ "$*" = --small ] || { echo "usage: bash apps/study/report.sh [--small]" >&2; exit 2; }
install_needed python3-matplotlib python3-numpy
configure build/release -DCMAKE_BUILD_TYPE=Release -DWEDGE_TESTS=OFF -DWEDGE_PERF=OFF
cmake --build build/release -j "$(nproc)" --target wedge
export WEDGE=$PWD/build/release/wedge

if [ $# -eq 1 ]; then
  out=build/study/small runs=build/study/small/runs
  mkdir -p $out
  RUNS=$PWD/$runs bash apps/study/study.sh $out/work small_pile small_hopper
else
  out=build/study runs=build/study/runs
  python3 apps/study/kept.py unpack $runs
fi
bash apps/study/compare.sh $runs $out/comparisons
"$WEDGE" report $runs --compare $out/comparisons/*.csv -o $out/report.html \
  --title "Sectors against the full vessel (made by: bash apps/study/report.sh${*:+ $*})"
