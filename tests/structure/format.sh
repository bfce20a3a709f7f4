#!/usr/bin/env bash
# format.sh SOURCE_DIR: fails where a source is not as clang-format 14 writes it with the repository's .clang-format.
# Status 77, skipped, where there is no clang-format 14.
set -u
cd "$1" || exit 2
if ! command -v clang-format-14 >/dev/null; then
  echo "skipped: clang-format-14 is not installed, so the format of the sources is not checked"
  exit 77
fi
find mesh param remesh coder metrics experiments cli python bench tests gsp.h \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 clang-format-14 --dry-run -Werror || {
  echo "where that is not meant: clang-format-14 -i FILE"
  exit 1
}
