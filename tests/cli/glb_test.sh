#!/usr/bin/env bash
# glb_test.sh GSP GOLDEN: binary glTF of streams, whole and cut, read by glb_test.py against the PLY of the same bytes.
set -eu
gsp=$1
golden=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for stream in sphere-loop sheet-butterfly displaced-torus creases-lens; do
  for bytes in 300 100000; do
    "$gsp" decode "$golden/$stream.pgc" --bytes "$bytes" -o "$work/d.sr.ply" > "$work/out.txt"
    "$gsp" decode "$golden/$stream.pgc" --bytes "$bytes" -o "$work/d.glb" > "$work/out.txt"
    "$gsp" decode "$golden/$stream.pgc" --bytes "$bytes" -o "$work/levels.glb" --levels --json > "$work/levels.json"
    python3 "$here/glb_test.py" "$work/d.sr.ply" "$work/d.glb" "$work/levels.glb" "$work/levels.json"
  done
done
