#!/usr/bin/env bash
# scripts/check-includes.sh [FOLDER]...: compiles every source of some folders, or of all, by itself, without the unity
# build, and every header that has no source, and prints what fails or warns: an include that is missing shows here
# alone. Sources include their own header first. At 2 CPU seconds a file it takes ten minutes, so that ./run-tests does
# not run it. Exit status: 0 nothing was found, 1 something was.
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$gsp_root"
cmake --preset dev >/dev/null
found=$(python3 - "$@" <<'PYTHON' | xargs -P "$(nproc)" -d '\n' -n 1 bash -c 2>&1 || true
import json, pathlib, re, shlex, sys

root = pathlib.Path.cwd()
folders = sys.argv[1:] or ["mesh", "param", "remesh", "coder", "metrics", "experiments", "cli", "tests"]
flags = {}  # by folder of the source
for entry in json.load(open("build/dev/compile_commands.json")):
    source = pathlib.Path(entry["file"])
    if not source.is_relative_to(root):
        continue
    source = source.relative_to(root)
    command = re.sub(r" -o \S+ -c \S+$", "", entry["command"]).replace(" -O3 ", " -O0 ")
    command = f"cd {shlex.quote(entry['directory'])} && {command} -fsyntax-only"
    flags[source.parent] = command
    if source.parts[0] in folders:
        print(f"{command} {entry['file']}")
for folder in folders:
    for header in sorted(pathlib.Path(folder).rglob("*.h")):
        room = next((p for p in header.parents if p in flags), None)
        if room is not None and not header.with_suffix(".cpp").exists():
            print(f"{flags[room]} -include {root / header} -x c++ /dev/null")
PYTHON
)
[ -z "$found" ] && exit 0
printf '%s\n' "$found"
exit 1
