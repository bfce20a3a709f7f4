#!/usr/bin/env bash
# false_alarms.sh GSP RECIPE WORK: a baseline of 8 replicates of RECIPE, and 20 runs of one further replicate each held to it: how many pass.
set -u
gsp=$1 recipe=$2 work=$3
mkdir -p "$work"
"$gsp" sweep "$recipe" --store "$work/store" --replicates 8 --quiet >/dev/null || exit 1
"$gsp" baseline "$work/store" -o "$work/baseline.json" --quiet
passed=0
for run in $(seq 101 120); do
  { echo "replicate = $run"; echo "name = \"run-$run\""; cat "$recipe"; } > "$work/run-$run.toml"
  "$gsp" sweep "$work/run-$run.toml" --store "$work/store" --quiet >/dev/null
  if "$gsp" check "$work/store" --recipe "run-$run" --baseline "$work/baseline.json" --ignore-times > "$work/run-$run.txt" 2>&1; then
    passed=$((passed + 1))
  else
    echo "run $run:"; grep -i "regressed\|changed" "$work/run-$run.txt" | head -5
  fi
done
echo "$passed of 20 passed"
