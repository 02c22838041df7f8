#!/usr/bin/env bash
# run.sh: builds wedge with assertions and warnings as errors and runs every test. With --clang: with clang.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/install_needed.sh

case "${1:-}" in
  "") folder=build/tests compiler=g++ packages=(g++) ;;
  --clang) folder=build/tests-clang compiler=clang++ packages=(clang libomp-dev) ;;
  *) echo "usage: bash tests/run.sh [--clang]" >&2; exit 2 ;;
esac
if command -v "$compiler" >/dev/null && [ "$compiler" = g++ ]; then packages=(); fi
install_needed "${packages[@]}"
configure "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DWEDGE_ASSERTIONS=ON -DWEDGE_WARNINGS_AS_ERRORS=ON -DWEDGE_TESTS=ON
cmake --build "$folder" -j "$(nproc)"
exec ctest --test-dir "$folder" --output-on-failure -j 2
