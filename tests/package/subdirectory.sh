#!/usr/bin/env bash
# subdirectory.sh SOURCE_DIR WORK OPTION...: takes gsp's sources in as a part of the consumer, and compiles the consumer's own
# objects. Compiling gsp once more takes minutes: GSP_PACKAGE_TEST=whole does that too, links and runs.
source "$(dirname "${BASH_SOURCE[0]}")/consumer.sh"
source_dir=$1 work=$2
shift 2
mkdir -p "$work"
configure_consumer "$source_dir" "$work" -DGSP_SOURCE="$source_dir" -DCMAKE_BUILD_TYPE=Release "$@"
if [ "${GSP_PACKAGE_TEST-}" = whole ]; then
  run_consumer "$work"
else
  cmake --build "$work/build" --target CMakeFiles/consumer.dir/consumer.cpp.o CMakeFiles/readme.dir/readme.cpp.o
fi
