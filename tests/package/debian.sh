#!/usr/bin/env bash
# debian.sh BUILD_DIR WORK: makes the Debian package, unpacks it and runs what is in it. Status 77, skipped, without Debian's
# tools.
set -euo pipefail
build=$1 work=$2
command -v dpkg-deb >/dev/null && command -v dpkg-shlibdeps >/dev/null || exit 77
rm -rf "$work"
mkdir -p "$work"
cd "$build"
cpack -G DEB -B "$work" >"$work/log"
dpkg-deb -x "$work"/gsp_*.deb "$work/root"
dpkg-deb -f "$work"/gsp_*.deb Depends | grep -q libtbb
"$work/root/usr/bin/gsp" --help | grep -q parameterize
for page in "$work"/root/usr/share/man/man1/gsp{,-parameterize,-sweep}.1; do
  [ -s "$page" ]
done
bash -n "$work/root/usr/share/bash-completion/completions/gsp"
module=$work/root/usr/lib/python3/dist-packages
[ ! -d "$module" ] || ! /usr/bin/python3 -c 'import numpy' || PYTHONPATH=$module /usr/bin/python3 -c '
import gsp
assert gsp.topology(*gsp.torus(8, 6)).components[0].genus == 1'
