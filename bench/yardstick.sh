#!/usr/bin/env bash
# yardstick.sh BUILD MESH [RUNS [OPTION...]]: `gsp parameterize MESH OPTION...` on two threads over the yardstick, which
# decimates the same surface to the base's number of faces with OpenMesh on one: whole processes, reading and writing
# included. Medians of RUNS runs (5) of each in turn, wall and CPU seconds, and their ratios.
# Wall means something only where nothing else runs.
set -eu
build=$1 mesh=$2 runs=${3:-5}
shift $(($# < 3 ? $# : 3))
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

# timed NAME COMMAND...: appends wall and CPU seconds to NAME.
timed() {
  local name=$1
  shift
  TIMEFORMAT='%R %U %S'
  { time "$@" > "$work/out" 2> "$work/err" || { cat "$work/err" >&2; exit 1; } } 2>> "$work/$name"
}

# median NAME EXPRESSION: of an awk expression of the three times.
median() { awk "{print $2}" "$work/$1" | sort -g | awk '{x[NR] = $1} END {print (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2}'; }

for _ in $(seq "$runs"); do
  timed gsp "$build/cli/gsp" parameterize "$mesh" -o "$work/map.param.ply" --threads 2 --quiet "$@"
  faces=$(awk '$1 == "base" && $2 == "faces" {print $3}' "$work/out")
  timed yardstick "$build/bench/yardstick" "$mesh" "$faces" "$work/decimated.ply"
done
echo "$faces faces; gsp $(median gsp '$1') s wall, $(median gsp '$2 + $3') s CPU;" \
  "yardstick $(median yardstick '$1') s wall, $(median yardstick '$2 + $3') s CPU"
awk -v a="$(median gsp '$1')" -v b="$(median yardstick '$1')" -v c="$(median gsp '$2 + $3')" -v d="$(median yardstick '$2 + $3')" \
  'BEGIN {printf "wall of gsp over the yardstick %.2f, CPU %.2f\n", a / b, c / d}'
