#!/usr/bin/env bash
# page_test.sh GSP: sweeps a small shape, reports on it, opens the page from disk in headless Chromium and does there what a
# reader would (page_test.js). Says that it was skipped (status 77) where there is no Chromium.
set -eu
gsp=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/experiments/browser.sh
source "$here/../browser.sh"
browser=$(find_browser)
work=$(mktemp -d)
trap 'rm -rf "$work" || true' EXIT

cat > "$work/tiny.toml" <<'TOML'
models = ["shape:dish"]
method = ["gsp", "maps-smoothed"]
base_vertices = 12
samples = 2000
TOML
"$gsp" sweep "$work/tiny.toml" --store "$work/store" --quiet > "$work/sweep.txt"
# As it is, and as a gsp without emscripten makes it.
for stored in '' --stored-surfaces; do
  "$gsp" report "$work/store" -o "$work/report$stored" --no-figures --quiet $stored > "$work/report.txt"
  run_in_page "$browser" "$work/report$stored/index.html" "$here/page_test.js"
done
