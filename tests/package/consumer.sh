# What the tests of the package have in common. Sourced with bash, never run.
# shellcheck shell=bash
set -euo pipefail

# readme_example SOURCE_DIR FIRST_LINE: the indented block of the README that starts with that line.
readme_example() {
  awk -v first="    $2" '$0 == first {inside = 1} inside && /^[^ ]/ {exit} inside {print substr($0, 5)}' "$1/README.md"
}

# configure_consumer SOURCE_DIR WORK OPTION...: makes the project `consumer` ready in WORK/build.
configure_consumer() {
  local source=$1 work=$2
  shift 2
  readme_example "$source" '#include <gsp/gsp.h>' >"$work/readme.cpp"
  [ -s "$work/readme.cpp" ]
  cmake --fresh -S "$source/tests/package/consumer" -B "$work/build" -DREADME_EXAMPLE="$work/readme.cpp" "$@"
}

# run_consumer WORK: builds its programs and runs them.
run_consumer() {
  local program
  cd "$1/build"
  cmake --build .
  ./consumer
  for program in anchors readme; do
    [ ! -x "$program" ] || "./$program"
  done
}
