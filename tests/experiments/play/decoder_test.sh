#!/usr/bin/env bash
# decoder_test.sh DECODER.JS DECODER.WASM GOLDEN: decoder_test.js in Node. Says that it was skipped (status 77) where there
# is no Node, or no module because there is no emscripten.
set -eu
[ -s "$2" ] || {
  echo "skipped: the decoder for browsers was not built (apt-get install emscripten)"
  exit 77
}
command -v node > /dev/null || {
  echo "skipped: no node to run the decoder for browsers in"
  exit 77
}
exec node "$(dirname "${BASH_SOURCE[0]}")/decoder_test.js" "$@"
