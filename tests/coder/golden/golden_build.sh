#!/usr/bin/env bash
# golden_build.sh GOLDEN PROGRAM SOURCE EMULATOR LAUNCHER COMPILER OPTION...: compiles SOURCE as PROGRAM, by way of LAUNCHER (ccache)
# where that is not empty, and runs it on the streams in GOLDEN, on EMULATOR where that is not empty. Says that it was skipped (status 77) where one of the tools is missing:
# CMake gives a name that ends in -NOTFOUND for those.
set -eu
golden=$1 program=$2 source=$3 emulator=$4 launcher=$5 compiler=$6
shift 6
for tool in "$emulator" "$compiler"; do
  case $tool in
    *-NOTFOUND)
      echo "skipped: ${tool%-NOTFOUND} is missing (Debian: clang, g++-aarch64-linux-gnu, qemu-user)"
      exit 77
      ;;
  esac
done
${launcher:+"$launcher"} "$compiler" "$@" -c "$source" -o "$program.o"
"$compiler" "$@" "$program.o" -o "$program"
${emulator:+"$emulator"} "$program" "$golden"
