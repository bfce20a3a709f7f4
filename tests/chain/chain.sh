#!/usr/bin/env bash
# chain.sh GSP SURFACE...: every surface through parameterize, remesh, encode, decode and distance. Prints a line for each:
# the remesh's and the whole stream's distance in dB, or the step that failed. A surface that `gsp info` calls unusable, and
# parameterize refuses with exit status 3, counts as refused. Options for parameterize and remesh: GSP_PARAMETERIZE,
# GSP_REMESH. Exit status: 1 where a step failed, or where no surface was there.
set -u
gsp=$1
shift
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0 done=0 refused=0

step() {
  local name=$1
  shift
  "$@" >"$folder/out" 2>"$folder/err" && return 0
  status=$?
  printf '%s: %s failed with status %d: %s\n' "$surface" "$name" "$status" "$(tail -n 1 "$folder/err")"
  return 1
}

psnr() { sed -n 's/.*"psnr_db": *\([0-9.a-z]*\).*/\1/p' "$folder/out" | head -n 1; }

chain() {
  local map="$folder/m.param.ply" remesh="$folder/r.sr.ply" stream="$folder/s.pgc" decoded="$folder/d.sr.ply" ceiling
  step parameterize "$gsp" parameterize "$surface" -o "$map" --check --quiet ${GSP_PARAMETERIZE-} || return 1
  step remesh "$gsp" remesh "$map" -o "$remesh" --quiet ${GSP_REMESH-} || return 1
  step encode "$gsp" encode "$remesh" -o "$stream" --quiet || return 1
  step decode "$gsp" decode "$stream" -o "$decoded" --quiet || return 1
  step 'distance to the remesh' "$gsp" distance "$surface" "$remesh" --samples 50000 --json --quiet || return 1
  ceiling=$(psnr)
  step distance "$gsp" distance "$surface" "$decoded" --samples 50000 --json --quiet || return 1
  printf '%s: remesh %s dB, decoded %s dB\n' "$surface" "$ceiling" "$(psnr)"
}

for surface in "$@"; do
  status=0
  if chain; then
    done=$((done + 1))
  elif [ "$status" -eq 3 ] && ! "$gsp" info "$surface" --quiet >/dev/null 2>&1; then
    refused=$((refused + 1))
  else
    failed=$((failed + 1))
  fi
done
printf '%d passed, %d failed, %d skipped\n' "$done" "$failed" "$refused"
[ "$failed" -eq 0 ] && [ $((done + refused)) -gt 0 ]
