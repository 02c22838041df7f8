#!/usr/bin/env bash
# run.sh: builds wedge with assertions and warnings as errors and runs every test but the long ones. Other ways:
#   --clang           built with clang
#   --asan            under the address and undefined-behaviour sanitizers
#   --tsan            under the thread sanitizer, with clang and its OpenMP runtime
#   --nightly         the long ones: fifty kills, a heavy drop, two million grains, clang-tidy, and perf/smoke/smoke.sh,
#                     which fails when the step has become slower
#   --validate        those that compare with known numbers, and the hard cases; writes their tables into tests/README.md
#   --fuzz [SECONDS]  no tests: each reader under libFuzzer for so long (600 s), one after the other
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
. apps/setup/install_needed.sh

usage() {
  echo "usage: bash tests/run.sh [--clang | --asan | --tsan | --nightly | --validate | --fuzz [SECONDS]]" >&2
  exit 2
}

# build FOLDER COMPILER OPTION...
build() {
  local folder=$1 compiler=$2
  shift 2
  configure "$folder" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" -DWEDGE_ASSERTIONS=ON \
    -DWEDGE_TESTS=ON "$@"
  cmake --build "$folder" -j "$(nproc)"
}

# archer_library: tells the thread sanitizer what OpenMP orders; comes with libomp.
archer_library() {
  local found
  found=$(find /usr/lib/llvm-* -name libarcher.so 2>/dev/null | sort -V | tail -n 1)
  [ -n "$found" ] || { echo "error: libarcher.so of libomp is missing: false alarms would drown the true ones" >&2; exit 1; }
  echo "$found"
}

# in_hdf5 TARGET FIND: is it libhdf5 that falls over this find, called by wedge or not, or nobody when it is read alone?
in_hdf5() {
  local said
  said=$(timeout 60 "$1" "$2" 2>&1) && return 0
  echo "$said" | awk '/^ *#[0-9]+ / && / in wedge::/ { exit 1 } /^ *#[0-9]+ / && /libhdf5/ { found = 1; exit 0 }
    END { exit !found }'
}

# fuzz_all SECONDS: finds are put into build/fuzz/runs/READER/finds; what is worth keeping goes to tests/fuzz/finds by hand.
fuzz_all() {
  local seconds=$1 reader folder go_on outcome find failed=0
  for reader in scene csv checkpoint checkpoint_bytes; do
    folder=build/fuzz/runs/$reader
    mkdir -p "$folder/corpus" "$folder/finds" tests/fuzz/finds/$reader
    echo "== $reader: $seconds s"
    # libhdf5 itself falls over some damaged files: go on behind them.
    go_on=()
    [ $reader != checkpoint_bytes ] || go_on=(-fork=1 -ignore_crashes=1 -ignore_ooms=1 -ignore_timeouts=1)
    outcome=0
    # A tmpfs, where there is one: the readers take files, and write_checkpoint syncs them.
    (cd "$folder" && export TMPDIR="$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)" &&
      # libhdf5 believes lengths in damaged files; it takes a refusal of memory well.
      export ASAN_OPTIONS=allocator_may_return_null=1 &&
      export LSAN_OPTIONS=suppressions=$OLDPWD/tests/support/leaks.supp:print_suppressions=0 &&
      ../../tests/fuzz_$reader corpus ../../../../tests/fuzz/seeds/$reader ../../../../tests/fuzz/finds/$reader \
        "${go_on[@]}" -dict=../../../../tests/fuzz/${reader%_bytes}.dict -artifact_prefix=finds/ -max_total_time="$seconds" \
        -timeout=20 -rss_limit_mb=3000 -malloc_limit_mb=1000000 -max_len=65536 -print_final_stats=1 >log 2>&1 || outcome=1
      [ $outcome -eq 0 ] || [ $reader = checkpoint_bytes ] || exit 1
      for find in finds/*; do
        [ ! -e "$find" ] || in_hdf5 ../../tests/fuzz_$reader "$find" || { echo "in wedge: $folder/$find"; outcome=2; }
      done
      echo "$(find finds -type f | wc -l) finds, $([ $outcome -eq 2 ] && echo some of them || echo none) in wedge"
      [ $outcome -ne 2 ]) || failed=1
    grep -E "stat::number_of_executed_units|SUMMARY" "$folder/log" || grep -E "^#[0-9]+:" "$folder/log" | tail -n 1
  done
  return $failed
}

# rows_of NAME: the cases that the table NAME of tests/README.md has.
rows_of() {
  awk -F '|' -v name="$1" '$0 == "<!-- end of " name " -->" { inside = 0 } inside && ++n > 2 { print $2 }
    $0 ~ "^<!-- " name ":" { inside = 1 }' tests/README.md | sort -u
}

# write_table NAME FILE: puts the rows of the table NAME in FILE between its markers in tests/README.md, in order.
# Says which cases the table had and has no more; returns 1 then.
write_table() {
  rows_of "$1" >"$2.before"
  LC_ALL=C sort -t "$(printf '\t')" -k 2 "$2" | awk -F '\t' -v name="$1" '
    FNR == NR { if ($1 == name) rows = rows $3 "\n"; next }
    $0 == "<!-- end of " name " -->" { skip = 0 }
    !skip { print }
    $0 ~ "^<!-- " name ":" { head = 2; next }
    head && --head == 0 { printf "%s", rows; skip = 1 }
  ' - tests/README.md >"$2.md"
  cat "$2.md" >tests/README.md
  rows_of "$1" | comm -23 "$2.before" - >"$2.gone"
  [ ! -s "$2.gone" ] || { sed "s/^/error: the table of $1 has lost the case/" "$2.gone" >&2; return 1; }
}

# validate FOLDER: runs the tests that write rows, and writes the tables.
validate() {
  local rows outcome=0 table
  rows=$(mktemp -d)
  export WEDGE_VALIDATION_ROWS="$rows/rows"
  ctest --test-dir "$1" --output-on-failure -j 2 -L 'unit|validate|nightly' -E kill || outcome=$?
  for table in "known answers" orders "hard cases"; do write_table "$table" "$WEDGE_VALIDATION_ROWS" || outcome=1; done
  rm -r "$rows"
  echo "The tables of tests/README.md are those of this run."
  return $outcome
}

[ $# -le 2 ] || usage
mode=${1:-}
[ $# -le 1 ] || [ "$mode" = --fuzz ] || usage
case "$mode" in
  "" | --nightly | --validate)
    needed=()
    command -v g++ >/dev/null || needed+=(g++)
    # for perf/smoke, the report and the study, the style
    case "$mode" in
      "") needed+=(binutils python3-matplotlib python3-numpy clang-format) ;;
      --nightly) needed+=(binutils valgrind clang-tidy) ;;
    esac
    install_needed "${needed[@]}"
    build build/tests g++ -DWEDGE_WARNINGS_AS_ERRORS=ON
    [ "$mode" != --validate ] || { validate build/tests; exit; }
    [ "$mode" != --nightly ] || exec ctest --test-dir build/tests --output-on-failure -L nightly
    exec ctest --test-dir build/tests --output-on-failure -j 2 -LE nightly ;;
  --clang)
    install_needed clang libomp-dev
    build build/tests-clang clang++ -DWEDGE_WARNINGS_AS_ERRORS=ON
    exec ctest --test-dir build/tests-clang --output-on-failure -j 2 -LE nightly ;;
  --asan)
    install_needed clang libomp-dev
    # Not with gcc 12: it takes half an hour for the loops over packs alone, and misaligns vectors of 64 bytes on the
    # stack that the sanitizer makes up (GCC bug 110027).
    build build/tests-asan clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g" \
      -DWEDGE_SANITIZE=address,undefined -DWEDGE_NATIVE=OFF -DWEDGE_PERF=OFF
    export ASAN_OPTIONS=detect_stack_use_after_return=1
    export LSAN_OPTIONS=suppressions=$PWD/tests/support/leaks.supp:print_suppressions=0
    exec ctest --test-dir build/tests-asan --output-on-failure -j 2 -LE nightly ;;
  --tsan)
    install_needed clang libomp-dev llvm
    build build/tests-tsan clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DWEDGE_SANITIZE=thread -DWEDGE_PERF=OFF
    # libomp is not instrumented: its own locks are left out, and Archer tells the sanitizer what they order.
    export TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1
    OMP_TOOL_LIBRARIES=$(archer_library)
    export OMP_TOOL_LIBRARIES
    exec ctest --test-dir build/tests-tsan --output-on-failure -j 2 -LE nightly ;;
  --fuzz)
    case "${2:-600}" in *[!0-9]*) usage ;; esac
    install_needed clang libomp-dev
    build build/fuzz clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DWEDGE_SANITIZE=address,undefined -DWEDGE_FUZZ=ON \
      -DWEDGE_NATIVE=OFF -DWEDGE_PERF=OFF
    fuzz_all "${2:-600}" ;;
  *) usage ;;
esac
