#!/usr/bin/env bash
# run.sh: builds wedge with assertions and warnings as errors and runs every test. With --clang: with clang. With
# --validate: runs the tests that compare with known numbers and writes their tables into tests/README.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/install_needed.sh

case "${1:-}" in
  "") folder=build/tests compiler=g++ packages=(g++) ;;
  --validate) folder=build/tests compiler=g++ packages=(g++) ;;
  --clang) folder=build/tests-clang compiler=clang++ packages=(clang libomp-dev) ;;
  *) echo "usage: bash tests/run.sh [--clang | --validate]" >&2; exit 2 ;;
esac
if command -v "$compiler" >/dev/null && [ "$compiler" = g++ ]; then packages=(); fi
install_needed "${packages[@]}"
configure "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" \
  -DWEDGE_ASSERTIONS=ON -DWEDGE_WARNINGS_AS_ERRORS=ON -DWEDGE_TESTS=ON
cmake --build "$folder" -j "$(nproc)"
[ "${1:-}" = --validate ] || exec ctest --test-dir "$folder" --output-on-failure -j 2 -LE nightly

# write_table NAME FILE: puts the rows of the table NAME in FILE between its markers in tests/README.md, in order.
write_table() {
  LC_ALL=C sort -t "$(printf '\t')" -k 2 "$2" | awk -F '\t' -v name="$1" '
    FNR == NR { if ($1 == name) rows = rows $3 "\n"; next }
    $0 == "<!-- end of " name " -->" { skip = 0 }
    !skip { print }
    $0 ~ "^<!-- " name ":" { head = 2; next }
    head && --head == 0 { printf "%s", rows; skip = 1 }
  ' - tests/README.md >"$2.md"
  cat "$2.md" >tests/README.md
}

rows=$(mktemp -d)
trap 'rm -r "$rows"' EXIT
export WEDGE_LADDER="$rows/rows"
outcome=0
ctest --test-dir "$folder" --output-on-failure -j 2 -L 'unit|validate|nightly' || outcome=$?
write_table rungs "$WEDGE_LADDER"
write_table orders "$WEDGE_LADDER"
write_table hard "$WEDGE_LADDER"
echo "The tables of tests/README.md are those of this run."
exit "$outcome"
