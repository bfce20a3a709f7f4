#!/usr/bin/env bash
# include_direction.sh SOURCE_DIR: fails where a folder includes against the direction of the design, or where a header
# of a heavy library shows in one of ours. CMake's link rules cannot see either: every part is on one include path.
set -u
cd "$1" || exit 2
failures=0

# refuse SENTENCE PATTERN FILE...: no file may hold a line that matches.
refuse() {
  local sentence=$1 pattern=$2 found
  shift 2
  found=$(grep -nE "$pattern" "$@" /dev/null) || return 0
  printf '%s:\n%s\n' "$sentence" "$found"
  failures=$((failures + 1))
}

# may_include FOLDER ALLOWED: files of FOLDER include, of our folders, itself and ALLOWED (separated by |) only.
may_include() {
  local folder=$1 allowed=$2 part others=''
  for part in mesh param remesh coder metrics experiments cli; do
    [[ "|$folder|$allowed|" == *"|$part|"* ]] || others+="${others:+|}$part"
  done
  refuse "$folder may include $allowed only" "^ *# *include *\"($others)/" "$folder"/{,*/}*.h "$folder"/{,*/}*.cpp
}

shopt -s nullglob
may_include mesh ''
may_include param 'mesh'
may_include remesh 'param|mesh'
may_include coder 'remesh|mesh'
may_include metrics 'param|mesh'
may_include experiments 'mesh|param|remesh|coder|metrics'
refuse 'the coder knows the semi-regular mesh only, not the remesher' \
  '"remesh/(remesh|param)' coder/*.h coder/*.cpp
refuse 'metrics know the result of a parameterization only, not the parameterizer' \
  '"param/parameterize\.h"' metrics/*.h metrics/*.cpp
refuse 'a heavy library belongs into one .cpp' \
  '^ *# *include *<(CLI|draco|OpenMesh|sqlite3|toml\+\+|tbb|png|xxhash)' {mesh,param,remesh,coder,metrics,experiments,cli}/{,*/}*.h
exit $((failures > 0))
