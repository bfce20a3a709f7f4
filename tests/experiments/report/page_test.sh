#!/usr/bin/env bash
# page_test.sh GSP: sweeps a small shape, reports on it, opens the page from disk in headless Chromium and does there what a
# reader would (page_test.js). Says that it was skipped (status 77) where there is no Chromium.
set -eu
gsp=$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || {
  echo "skipped: no chromium to open the report in"
  exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work" || true' EXIT

cat > "$work/tiny.toml" <<'TOML'
models = ["shape:dish"]
method = ["gsp", "maps-smoothed"]
base_vertices = 12
samples = 2000
TOML
"$gsp" sweep "$work/tiny.toml" --store "$work/store" --quiet > "$work/sweep.txt"
"$gsp" report "$work/store" -o "$work/report" --no-figures --quiet > "$work/report.txt"

# The test's scripts go around the page's own; everything else stays as a reader gets it.
{
  echo "<script>window.pageErrors = []; addEventListener('error', (e) => pageErrors.push(e.message));"
  echo "for (const level of ['error', 'warn']) console[level] = (...text) => pageErrors.push(text.join(' '));</script>"
  cat "$work/report/index.html"
  echo "<script>"
  cat "$here/page_test.js"
  echo "</script>"
} > "$work/report/test.html"

# Software rendering, so that a machine without a graphics card draws the 3D view too. Real time: under a virtual clock the
# browser may end before it has drawn a frame.
timeout 120 "$browser" --headless=new --no-sandbox --disable-dev-shm-usage --user-data-dir="$work/profile" \
  --use-angle=swiftshader --enable-unsafe-swiftshader --enable-logging=stderr --window-size=1200,2400 \
  "file://$work/report/test.html" > /dev/null 2> "$work/browser.txt" &
while kill -0 $! 2> /dev/null && ! grep -q 'page-test:' "$work/browser.txt"; do sleep 0.2; done
kill $! 2> /dev/null || true
wait $! || true
grep -o 'page-test: .*' "$work/browser.txt" || {
  cat "$work/browser.txt"
  echo "the test did not run to its end"
  exit 1
}
grep 'CONSOLE' "$work/browser.txt" | grep -v 'page-test:' && { echo "the console is not silent"; exit 1; }
grep -q 'page-test: passed' "$work/browser.txt"
