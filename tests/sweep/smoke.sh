#!/usr/bin/env bash
# smoke.sh GSP STORE: sweeps the smoke recipe from nothing and holds it to the committed baseline. The store remains.
set -euo pipefail
gsp=$1 store=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

rm -rf "$store"
"$gsp" sweep experiments/recipes/smoke.toml --store "$store" --jobs 2 --quiet >/dev/null
# Times are not compared: other tests run at the same time.
if ! "$gsp" check "$store" --baseline "$here/smoke-baseline.json" --ignore-times --junit "$store/junit.xml"; then
  echo "Where that is wanted: $gsp baseline $store -o tests/sweep/smoke-baseline.json"
  exit 1
fi
# Not piped: grep would close the pipe while the sweep still writes.
again=$("$gsp" sweep experiments/recipes/smoke.toml --store "$store" --quiet --json)
grep -q '"stages_run": 0' <<<"$again" ||
  { echo "a second sweep did not find everything done"; exit 1; }
