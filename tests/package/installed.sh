#!/usr/bin/env bash
# installed.sh SOURCE_DIR BUILD_DIR WORK OPTION...: installs the build, moves it, and builds the consumer with it, by
# CMake and by pkg-config.
source "$(dirname "${BASH_SOURCE[0]}")/consumer.sh"
source_dir=$1 build=$2 work=$3
shift 3
rm -rf "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/first" --strip >/dev/null
mv "$work/first" "$work/moved"
# No file of the package may know where it was built or first installed.
pc=$(dirname "$(find "$work/moved" -name gsp.pc)")
[ -f "$pc/../cmake/gsp/gspConfig.cmake" ]
if grep -rlE "$build|$work/first" "$pc" "$pc/../cmake" "$work/moved/include"; then
  echo "these files hold a path of this machine"
  exit 1
fi
configure_consumer "$source_dir" "$work" -DCMAKE_PREFIX_PATH="$work/moved" "$@"
run_consumer "$work"
"$work/moved/bin/gsp" info "$work/build/torus.ply" >/dev/null

command -v pkg-config >/dev/null || exit 0
# shellcheck disable=SC2046  # words of a command line
"${CXX:-c++}" -std=c++20 -O0 "$work/readme.cpp" $(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs gsp) -o "$work/by_pkg_config"
LD_LIBRARY_PATH=$(dirname "$pc") "$work/by_pkg_config"
