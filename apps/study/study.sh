#!/usr/bin/env bash
# study.sh FOLDER [SET...]: makes the runs of plan.sh in FOLDER, analyses each, and keeps what is worth keeping of it in
# runs/ beside this file. Runs that are there are not made again, interrupted ones go on: stop it and start it as you
# like. WEDGE: the program; JOBS: runs at a time, one thread each (default: processors); KEEP=1 leaves frames in FOLDER.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: bash apps/study/study.sh FOLDER [SET...]" >&2; exit 2; }
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export study
export WEDGE=${WEDGE:-$study/../../build/release/wedge}
[ -x "$WEDGE" ] || { echo "error: $WEDGE: no such program; build it first: bash apps/demo.sh" >&2; exit 4; }
export folder=$1
shift

state_of() { sed -n 's/.*"state": "\([a-z]*\)".*/\1/p' "$1/progress.json" 2>/dev/null || true; }

# one RUN SCENE SETTING...
one() {
  local name=$1 scene=$2 run=$folder/$1 settings=() word
  shift 2
  [ ! -e "$study/runs/$name/summary.json" ] || return 0
  for word in "$@"; do settings+=(--set "${word//_d/ d}"); done
  mkdir -p "$(dirname "$run")"
  case $(state_of "$run") in
    finished) ;;
    "") rm -rf "$run"; "$WEDGE" run "$study/$scene.toml" -o "$run" -j 1 "${settings[@]}" >"$run.log" 2>&1 ;;
    *) "$WEDGE" resume "$run" -j 1 >>"$run.log" 2>&1 ;;
  esac || { echo "$name: $(tail -n 1 "$run.log")"; return 0; }
  rm -rf "$run/checkpoints"
  echo "$name: made"
}
export -f one state_of

bash "$study/plan.sh" "$@" | xargs -P "${JOBS:-$(nproc)}" -d '\n' -I LINE \
  bash -c 'set -euo pipefail; read -ra words <<<"$1"; one "${words[@]}"' _ LINE
