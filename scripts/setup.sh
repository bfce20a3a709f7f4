# What ./reproduce and ./run-tests have in common: packages, build, sample meshes. Sourced with bash, never run.
# shellcheck shell=bash

set -euo pipefail

gsp_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
gsp_samples="$gsp_root/out/samples"

# Debian 12 packages that building, testing and drawing need.
gsp_packages=(
  g++ cmake ninja-build
  libeigen3-dev libopenmesh-dev libdraco-dev libtbb-dev libsuitesparse-dev libopenblas-dev liblbfgs-dev
  libcli11-dev nlohmann-json3-dev libfmt-dev libtomlplusplus-dev libsqlite3-dev libxxhash-dev catch2 libcgal-dev libbenchmark-dev gnuplot-nox
  libpng-dev libjs-three libboost-dev
  pybind11-dev python3-dev python3-numpy python3-pytest python3-matplotlib pkg-config
)
# A cluster of one node, for the test of sweeps through Slurm; Draco's tools, for that of external codecs.
[ "${CI-}" != true ] || gsp_packages+=(slurm-wlm munge draco)

say() { printf '%s\n' "$*" >&2; }

# Runs a command as root: directly, or through a sudo that asks for no password. Status 2 where neither is possible.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    sudo "$@"
  else
    return 2
  fi
}

# Installs the packages that are missing; prints the one line to run and exits with status 2 where it may not.
install_packages() {
  local package missing=()
  for package in "${gsp_packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  if ! as_root true; then
    say "These packages are missing, and installing them needs root. Run:"
    say "  apt-get install -y ${missing[*]}"
    exit 2
  fi
  say "installing ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

# build PRESET [TARGET...]: configures and builds into build/PRESET, through ccache where it is installed.
build() {
  local preset=$1 options=()
  shift
  command -v ccache >/dev/null && options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  say "building ($preset)"
  (cd "$gsp_root" && cmake --preset "$preset" "${options[@]}" >/dev/null &&
    cmake --build "build/$preset" ${1:+--target "$@"}) >&2
}

# Unpacks the meshes of the Debian package libcgal-demo into out/samples, once. Needs the network, no root.
fetch_samples() {
  [ -f "$gsp_samples/.complete" ] && return
  say "fetching the sample meshes of the Debian package libcgal-demo"
  local work="$gsp_root/out/samples.part"
  rm -rf "$work"
  mkdir -p "$work/meshes"
  # A fresh container has no package lists, and only root may fetch them.
  (cd "$work" && { apt-get download -qq libcgal-demo || { as_root apt-get update -qq && apt-get download -qq libcgal-demo; }; } &&
    dpkg-deb -x libcgal-demo_*.deb package &&
    tar -xzf package/usr/share/doc/libcgal-dev/data.tar.gz -C meshes --strip-components=2 data/meshes) >&2 || {
    rm -rf "$work"
    say "the sample meshes could not be fetched: apt-get download libcgal-demo failed"
    return 1
  }
  mv -T "$work/meshes" "$gsp_samples"
  rm -rf "$work"
  touch "$gsp_samples/.complete"
}
