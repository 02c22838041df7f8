# record.sh: to be sourced; the recorded counts and signatures, and how a check fails.
recorded=perf/smoke/smoke_counts.txt
toolchain="$(g++ --version 2>/dev/null | head -n 1), $(getconf GNU_LIBC_VERSION)"
export OMP_NUM_THREADS=1

failures=0
fail() {
  echo "FAILED: $1" >&2
  failures=$((failures + 1))
}

# record_of NAME: what is recorded under this name.
record_of() { awk -v name="$1" '$1 == name { $1 = ""; print substr($0, 2) }' "$recorded"; }

same_toolchain() { [ "$toolchain" = "$(record_of toolchain)" ]; }

# signature_of BENCH_STEP PRECISION THREADS
signature_of() { "$1" --signature --precision "$2" --threads "$3" | awk '/^signature/ { print $2 }'; }
