#!/usr/bin/env bash
# symbols.sh LIBRARY...: fails where a shared library has a symbol outside gsp::, or no SONAME with a version.
set -euo pipefail
for library in "$@"; do
  names=$(nm -D --defined-only --demangle "$library" | cut -d' ' -f3-)
  [ -n "$names" ]
  if grep -vE '^(typeinfo for |typeinfo name for |vtable for )?gsp::' <<<"$names"; then
    echo "$library exports these, which are not gsp's"
    exit 1
  fi
  readelf -d "$library" | grep -qE 'SONAME.*libgsp(-anchors)?\.so\.[0-9]+\.[0-9]+\]'
done
# Internals stay inside: what only our own rooms include is no symbol.
if nm -D --defined-only --demangle "$1" | grep -E 'gsp::(solve_sparse|AtomicFile|simplify)'; then
  echo "$1 exports internals"
  exit 1
fi
