#!/usr/bin/env bash
# external.sh GSP STORE: sweeps the recipe draco-tool and holds Draco's own tools to the built-in anchor: the same bytes and
# the same distances, row by row. Status 77 where the tools are not installed.
set -euo pipefail
gsp=$1 store=$2
command -v draco_encoder >/dev/null || { echo "skipped: draco_encoder is not installed"; exit 77; }

rm -rf "$store"
"$gsp" sweep experiments/recipes/draco-tool.toml --store "$store" --jobs 2 --quiet >/dev/null
# rows METHOD: model, bytes and distances; the built-in anchor has a lossless row besides.
rows() {
  awk -F, -v method="$1" '
    NR == 1 { for (i = 1; i <= NF; ++i) at[$i] = i; next }
    $at["method"] == method && $at["coder"] != "draco-lossless" {
      print $at["model"], $at["bytes"], $at["faces"], $at["rms_forward"], $at["rms_backward"], $at["psnr_db"]
    }' "$store/curve.csv"
}
[ "$(rows draco | wc -l)" -eq 21 ] || { echo "the anchor has $(rows draco | wc -l) rows, not 21"; exit 1; }
diff <(rows draco) <(rows draco-tool) || { echo "Draco's tools and the built-in anchor differ"; exit 1; }
