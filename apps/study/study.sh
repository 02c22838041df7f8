#!/usr/bin/env bash
# study.sh FOLDER [SET...]: makes in FOLDER the runs of plan.sh that data/ beside this file lacks, analyses each and
# reduces it into build/study/runs; at the end of each set it packs them into data/. Interrupted runs go on: stop it and
# start it as you like. WEDGE: the program; JOBS: runs at a time, one thread each (default: processors); KEEP=1 leaves
# frames in FOLDER; RUNS: a folder for the reduced runs, for which data/ is neither read nor written; COMMIT=1 commits
# data/ at the end of each set.
set -euo pipefail
[ $# -ge 1 ] || { echo "usage: bash apps/study/study.sh FOLDER [SET...]" >&2; exit 2; }
study=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export study
export WEDGE=${WEDGE:-$study/../../build/release/wedge}
[ -x "$WEDGE" ] || { echo "error: $WEDGE: no such program; build it first: bash apps/demo.sh" >&2; exit 4; }
export runs=${RUNS:-$study/../../build/study/runs}
export folder=$1
shift
[ $# -gt 0 ] || set -- pile hopper20 hopper40 sides angle
[ -n "${RUNS:-}" ] || python3 "$study/kept.py" unpack "$runs"

state_of() { sed -n 's/.*"state": "\([a-z]*\)".*/\1/p' "$1/progress.json" 2>/dev/null || true; }

# analysed RUN FOLDER: with the axis zones and wedges of the angles that a full vessel of its set is compared with.
analysed() {
  local angles=90,60,45,30
  case $1 in angle/*) angles=180,120,90,72,60,45,36,30,24,20,15 ;; esac
  "$WEDGE" analyse "$2" -j 1 --angles "$angles" --wedges 2 >>"$2.log" 2>&1
}

# rows FILE MOMENTS [PARTS]: the rows of these moments (and parts), expressions both, with the heading.
rows() { awk -F, -v moment="^($2)$" -v part="^(${3:-.*})$" 'NR == 1 || ($1 ~ moment && $2 ~ part)' "$1"; }

# reduced RUN FOLDER KEPT: puts what is kept of an analysed run into KEPT.
reduced() {
  local from=$2/results to=$3/results picture="" file
  mkdir -p "$to"
  cp "$2/scene.resolved.toml" "$3"
  # Where this machine keeps things is nobody's business.
  sed -e 's|"[^"]*/\([^"/]*\.toml\)"|"\1"|' -e "s|\"[^\"]*/$1\"|\"$1\"|" "$2/provenance.json" >"$3/provenance.json"
  [ ! -e "$from/flow.csv" ] || cp "$from/flow.csv" "$to"
  case $1 in
    angle/*)
      rows "$from/scalars.csv" "settle|flow_mean" >"$to/scalars.csv"
      rows "$from/distributions.csv" flow_mean >"$to/distributions.csv"
      rows "$from/radial.csv" flow_mean >"$to/radial.csv"
      ;;
    *pile/*)
      rows "$from/scalars.csv" "settle|collapse|collapse_mean|spread|pile" >"$to/scalars.csv"
      rows "$from/distributions.csv" "collapse|collapse_mean|spread|pile" >"$to/distributions.csv"
      rows "$from/radial.csv" "settle|collapse|pile" >"$to/radial.csv"
      { rows "$from/map.csv" pile
        rows "$from/map.csv" "collapse|collapse_mean|spread" whole | tail -n +2; } >"$to/map.csv"
      case $1 in *_s1) picture="collapse|spread|pile" ;; esac
      ;;
    *)
      rows "$from/scalars.csv" "settle|open|flow_mean" >"$to/scalars.csv"
      rows "$from/distributions.csv" "settle|open|flow_mean" >"$to/distributions.csv"
      rows "$from/radial.csv" "settle|open|flow_mean" >"$to/radial.csv"
      { rows "$from/map.csv" flow_mean
        rows "$from/map.csv" "settle|open" whole | tail -n +2; } >"$to/map.csv"
      case $1 in hopper40/*_s1 | small_hopper/*_s1) picture="open" ;; esac
      ;;
  esac
  if [ -n "$picture" ]; then
    for file in slice network cut; do rows "$from/$file.csv" "$picture" '.*' >"$to/$file.csv"; done
  fi
  cp "$from/summary.json" "$to"  # the last one: it says that the run is there
}

# one RUN SCENE SETTING...
one() {
  local name=$1 scene=$2 run=$folder/$1 kept=$runs/$1 settings=() word
  shift 2
  [ ! -e "$kept/results/summary.json" ] || return 0
  for word in "$@"; do settings+=(--set "${word//_d/ d}"); done
  mkdir -p "$(dirname "$run")"
  case $(state_of "$run") in
    finished) ;;
    "") rm -rf "$run"; "$WEDGE" run "$study/$scene.toml" -o "$run" -j 1 "${settings[@]}" >"$run.log" 2>&1 ;;
    *) "$WEDGE" resume "$run" -j 1 >>"$run.log" 2>&1 ;;
  esac && bash -euo pipefail -c 'analysed "$1" "$2"; reduced "$@"' _ "$name" "$run" "$kept" 2>>"$run.log" ||
    { echo "$name: $(tail -n 1 "$run.log")"; return 0; }
  [ -n "${KEEP:-}" ] || rm -rf "$run"
  echo "$name: done"
}
export -f analysed one reduced rows state_of

# kept SET: packs the set into data/ when it has runs that are not there.
kept() {
  local new
  new=$(find "$runs/$1" -name summary.json -newer "$runs/.unpacked" 2>/dev/null) || true
  [ -n "$new" ] || return 0
  python3 "$study/kept.py" pack "$runs" "$1"
  [ -n "${COMMIT:-}" ] || return 0
  git -C "$study" add data
  git -C "$study" diff --cached --quiet -- data || git -C "$study" commit -qm "Study: runs of $1" -- data
}

for set in "$@"; do
  bash "$study/plan.sh" "$set" | xargs -P "${JOBS:-$(nproc)}" -d '\n' -I LINE \
    bash -c 'set -euo pipefail; read -ra words <<<"$1"; one "${words[@]}"' _ LINE
  [ -n "${RUNS:-}" ] || kept "$set"
done
