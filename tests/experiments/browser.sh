# For tests that open a page in headless Chromium. Sourced with bash, never run.
# shellcheck shell=bash

# The browser's path. Ends the test as skipped (status 77) where there is none.
find_browser() {
  command -v chromium || command -v chromium-browser || command -v google-chrome || {
    echo "skipped: no chromium to open a page in" >&2
    exit 77
  }
}

# run_in_page BROWSER PAGE SCRIPT: opens the page from disk, and SCRIPT after its own scripts, until it logs
# "page-test: passed." or what failed. Errors of the page are in window.pageErrors, from before its own scripts on. Status
# 1 where the script failed, did not end, or the console was not silent.
run_in_page() {
  local browser=$1 page=$2 script=$3 folder test log running
  folder=$(dirname "$page")
  test=$folder/test.html log=$folder/browser.txt
  # The test's scripts go around the page's own; everything else stays as a reader gets it.
  {
    echo "<script>window.pageErrors = []; addEventListener('error', (e) => pageErrors.push(e.message));"
    echo "for (const level of ['error', 'warn']) console[level] = (...text) => pageErrors.push(text.join(' '));</script>"
    cat "$page"
    echo "<script>"
    cat "$(dirname "${BASH_SOURCE[0]}")/page_checks.js" "$script"
    echo "</script>"
  } > "$test"

  # Software rendering, so that a machine without a graphics card draws the 3D view too. Real time: under a virtual clock
  # the browser may end before it has drawn a frame.
  timeout 120 "$browser" --headless=new --no-sandbox --disable-dev-shm-usage --user-data-dir="$folder/profile" \
    --use-angle=swiftshader --enable-unsafe-swiftshader --enable-logging=stderr --window-size=1200,2400 \
    "file://$test" > /dev/null 2> "$log" &
  running=$!
  while kill -0 $running 2> /dev/null && ! grep -q 'page-test:' "$log"; do sleep 0.2; done
  kill $running 2> /dev/null || true
  wait $running || true
  grep -o 'page-test: .*' "$log" || {
    cat "$log"
    echo "the test did not run to its end"
    return 1
  }
  if grep 'CONSOLE' "$log" | grep -v 'page-test:'; then
    echo "the console is not silent"
    return 1
  fi
  grep -q 'page-test: passed' "$log"
}
