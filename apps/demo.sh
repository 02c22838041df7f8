#!/usr/bin/env bash
# demo.sh: builds wedge and runs its main job: a hopper, as the full vessel and as a sector of 90 degrees.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup/install_needed.sh

install_needed
configure build/release -DCMAKE_BUILD_TYPE=Release -DWEDGE_TESTS=OFF -DWEDGE_PERF=OFF
cmake --build build/release -j "$(nproc)"

wedge=build/release/wedge
out=out/demo
rm -rf "$out"
mkdir -p "$out"
echo
echo "The full vessel:"
"$wedge" run apps/scenes/demo.toml -o "$out/full"
echo
echo "A sector of 90 degrees:"
"$wedge" run apps/scenes/demo.toml -o "$out/sector90" --set domain.angle=90
echo
"$wedge" compare "$out/full" --with "$out/sector90"
echo "One run of each: rates of single runs of this size differ by 10 to 20 % from seed to seed, loads on the shell by a factor of two."

echo
echo "Pictures of a slice (any web browser opens them):"
find "$PWD/$out" -name 'slice_*.svg' | sort
echo "Grains and contacts in time (ParaView opens them):"
find "$PWD/$out" -name '*.hdf.series' | sort
