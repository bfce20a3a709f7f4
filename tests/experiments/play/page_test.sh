#!/usr/bin/env bash
# page_test.sh GSP STREAM: makes the page that plays a stream, opens it from disk in headless Chromium and does there what a
# reader would (page_test.js): what it decodes at three sizes is what GSP decodes, to the bit. Says that it was skipped
# (status 77) where there is no Chromium, or where GSP was built without emscripten.
set -eu
gsp=$1
stream=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=tests/experiments/browser.sh
source "$here/../browser.sh"
browser=$(find_browser)
work=$(mktemp -d)
trap 'rm -rf "$work" || true' EXIT

"$gsp" play "$stream" -o "$work/play.html" --title '</script><b>x@@play.js@@' --json > "$work/play.json" 2> "$work/error.txt" || {
  grep -q 'without the decoder for browsers' "$work/error.txt" || { cat "$work/error.txt"; exit 1; }
  echo "skipped: gsp was built without the decoder for browsers (apt-get install emscripten)"
  exit 77
}

size=$(stat -c %s "$stream")
for bytes in $((size / 20)) $((size / 4)) "$size"; do
  "$gsp" decode "$stream" --bytes "$bytes" -o "$work/$bytes.sr.ply" --quiet > "$work/decode.txt"
done
# The sizes with the positions of the native decoder.
python3 - "$work" $((size / 20)) $((size / 4)) "$size" > "$work/expected.js" <<'PYTHON'
import base64, json, re, sys
expected = []
for size in sys.argv[2:]:
    data = open(f"{sys.argv[1]}/{size}.sr.ply", "rb").read()
    header, body = data.split(b"end_header\n", 1)
    properties = re.search(rb"element vertex (\d+)\n((?:property .*\n)*)", header)
    assert properties[2].split(b"\n")[:-1] == [b"property double " + k for k in (b"x", b"y", b"z")], header
    expected.append({"bytes": int(size), "positions": base64.b64encode(body[: 24 * int(properties[1])]).decode()})
print(f"window.expected = {json.dumps(expected)};")
PYTHON
cat "$work/expected.js" "$here/page_test.js" > "$work/test.js"
run_in_page "$browser" "$work/play.html" "$work/test.js"
