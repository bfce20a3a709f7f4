#!/usr/bin/env bash
# crease_distance.sh BUILD BYTES BASE MESH...: the chain from surface to decoded prefix of BYTES with `--features none`
# and `auto`, BASE vertices (or auto), and for each how far its sharp edges are from the input's feature curves.
set -eu
build=$1 bytes=$2 base_vertices=$3
shift 3
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT

gsp() { "$build/cli/gsp" "$@" --quiet > "$work/out"; }

for mesh in "$@"; do
  for features in none auto; do
    gsp parameterize "$mesh" --features "$features" --base-vertices "$base_vertices" -o "$work/m.param.ply"
    base=$(awk '$1 == "base" && $2 == "vertices" {print $3}' "$work/out")
    given_way=$(awk '/^feature curves given way/ {print $5}' "$work/out")
    gsp remesh "$work/m.param.ply" -o "$work/r.sr.ply"
    gsp encode "$work/r.sr.ply" -o "$work/c.pgc"
    gsp decode "$work/c.pgc" --bytes "$bytes" -o "$work/d.sr.ply"
    echo "$(basename "$mesh"), features $features, base of $base, $given_way curves given way"
    "$build/bench/crease_distance" "$mesh" "$work/d.sr.ply" 10 20 30 40 60
  done
done
