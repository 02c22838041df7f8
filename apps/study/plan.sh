#!/usr/bin/env bash
# plan.sh [SET...]: prints the runs of these sets, one a line: SET/RUN, scene, then what `wedge run --set` sets, all
# separated by blanks. The study is the sets pile hopper20 hopper40 sides angle: those without a SET. The sets
# small_hopper and small_pile take minutes.
set -euo pipefail

# vessel WIDTH ORIFICE COUNT: settings of a hopper WIDTH d wide with an orifice of ORIFICE d and COUNT grains (of the
# full vessel), which fill a region 28 % full.
vessel() {
  awk -v w="$1" -v o="$2" -v n="$3" 'BEGIN { r = w / 2; c = o / 2; h = n * 4 / (6 * 0.28 * w * w)
    printf "wall.shell.profile=[[\"%g_d\",0],[\"%g_d\",\"%g_d\"]] ", r, r, h + 6
    printf "wall.floor.profile=[[\"%g_d\",0],[\"%g_d\",0]] ", c, r
    printf "wall.plug.profile=[[0,0],[\"%g_d\",0]] ", c
    printf "particles.count=%d ", n
    printf "particles.region={r=[0,\"%g_d\"],z=[0,\"%g_d\"]}", r, h }'
}

# Every angle for each seed, seeds in turn.
pile() {
  for seed in 1 2 3 4 5 6 7 8; do for angle in 360 90 60 45 30; do
    echo "pile/a${angle}_s$seed pile domain.angle=$angle particles.seed=$seed"
  done; done
}
hopper20() {  # a bed of 90 d
  for seed in 1 2 3 4 5 6 7 8; do for angle in 360 90 60 45 30; do
    echo "hopper20/a${angle}_s$seed hopper $(vessel 20 8 31008) domain.angle=$angle particles.seed=$seed"
  done; done
}
small_hopper() {
  for seed in 1 2; do for angle in 360 90 60 45 30; do
    echo "small_hopper/a${angle}_s$seed hopper $(vessel 16 8 7920) domain.angle=$angle particles.seed=$seed"
  done; done
}
small_pile() {  # a plate 20 d wide in a vessel of 28 d
  for seed in 1 2; do for angle in 360 90 60 45 30; do
    echo "small_pile/a${angle}_s$seed pile wall.shell.profile=[[\"14_d\",\"-10_d\"],[\"14_d\",0],[\"14_d\",\"45_d\"]]" \
      "wall.plate.profile=[[0,0],[\"10_d\",0]] wall.gate.profile=[[\"10_d\",0],[\"14_d\",0]] particles.count=8232" \
      "particles.region={r=[0,\"14_d\"],z=[0,\"27_d\"]} domain.angle=$angle particles.seed=$seed"
  done; done
}
hopper40() {  # the paper's
  for seed in 1 2; do for angle in 360 90 60 45 30; do
    echo "hopper40/a${angle}_s$seed hopper domain.angle=$angle particles.seed=$seed"
  done; done
}
sides() {  # what bounds a sector, in the vessel of set hopper20
  for seed in 1 2 3 4; do
    for angle in 90 45; do
      for sides in rigid frictionless; do
        echo "sides/a${angle}_${sides}_s$seed hopper $(vessel 20 8 31008) domain.angle=$angle domain.sides=$sides" \
          "particles.seed=$seed"
      done
      for axis in images pin line; do
        echo "sides/a${angle}_${axis}_s$seed hopper $(vessel 20 8 31008) domain.angle=$angle domain.axis=$axis" \
          "particles.seed=$seed"
      done
    done
    echo "sides/slot_s$seed slot particles.seed=$seed"
  done
}
# thin WIDTH ORIFICE COUNT ANGLE SEEDS: a bed of 1.2 widths. Each line begins with its seed.
thin() {
  for seed in $(seq 1 "$5"); do
    echo "$seed angle/w${1}_o${2}_a${4}_s$seed hopper $(vessel "$1" "$2" "$3") domain.angle=$4 particles.seed=$seed"
  done
}
all_thin() {
  local a o
  for a in "360 4" "180 4" "120 4" "90 6" "72 6" "60 6" "45 8" "36 8" "30 8" "24 8" "20 8" "15 8"; do
    thin 20 8 8280 "${a% *}" "${a#* }"
    thin 30 8 27720 "${a% *}" "${a#* }"
  done
  for o in 8 10 12; do
    for a in "360 2" "180 2" "120 2" "90 3" "72 3" "60 4" "45 4" "36 4" "30 4" "24 4" "20 4" "15 4"; do
      thin 40 "$o" 65160 "${a% *}" "${a#* }"
    done
  done
  # Most of these arch.
  for a in "360 2" "180 1" "120 1" "90 3" "72 3" "60 4" "45 4" "36 3" "30 3" "24 3" "20 3" "15 3"; do
    thin 40 6 65160 "${a% *}" "${a#* }"
  done
  for a in "360 1" "60 2" "45 2" "30 3"; do thin 60 8 220320 "${a% *}" "${a#* }"; done
}

# The first seed of every vessel and angle, then the second, ...
angle() { all_thin | sort -s -n -k 1,1 | cut -d " " -f 2-; }

[ $# -gt 0 ] || set -- pile hopper20 hopper40 sides angle
for name in "$@"; do
  case $name in
    pile | hopper20 | hopper40 | sides | angle | small_hopper | small_pile) "$name" ;;
    *) echo "error: '$name' is no set of the study: pile hopper20 hopper40 sides angle" >&2; exit 2 ;;
  esac
done
