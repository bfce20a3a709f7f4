#!/usr/bin/env bash
# slurm.sh GSP SMOKE_STORE: the smoke recipe through Slurm gives the numbers that SMOKE_STORE has from local workers.
# Uses the cluster at hand; in CI, as root, makes one of this machine. Exit status 77 (skipped) where there is neither.
set -euo pipefail
gsp=$1 expected=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

command -v sbatch >/dev/null || { echo "skipped: sbatch is not installed"; exit 77; }
work=$(mktemp -d)
cleanup() {
  [ -z "${own_cluster-}" ] || "$here/one_node_cluster.sh" stop "$work/cluster"
  rm -rf "$work"
}
trap cleanup EXIT
if ! timeout 5 sinfo -h >/dev/null 2>&1; then
  [ "${CI-}" = true ] && [ "$(id -u)" -eq 0 ] || { echo "skipped: no Slurm cluster answers"; exit 77; }
  own_cluster=yes
  # munged runs as another user and has to reach its folder.
  chmod 755 "$work"
  SLURM_CONF=$("$here/one_node_cluster.sh" start "$work/cluster")
  export SLURM_CONF
fi

"$gsp" sweep experiments/recipes/smoke.toml --store "$work/store" --slurm --quiet >/dev/null
cmp "$expected/curve.csv" "$work/store/curve.csv"
"$gsp" sweep experiments/recipes/smoke.toml --store "$work/store" --status | grep -q ' 0 failed, 0 waiting'
