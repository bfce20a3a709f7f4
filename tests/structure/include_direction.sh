#!/usr/bin/env bash
# include_direction.sh SOURCE_DIR: fails where a folder, or a room inside one, includes against the direction of the
# design, where a header of a heavy library shows in one of ours, or where a header is included by no test. CMake's link
# rules cannot see the first two: every part is on one include path.
set -u
shopt -s nullglob globstar
cd "$1" || exit 2
failures=0

fail() {
  printf '%s\n' "$@"
  failures=$((failures + 1))
}

# refuse SENTENCE PATTERN FILE...: no file may hold a line that matches.
refuse() {
  local sentence=$1 pattern=$2 found
  shift 2
  found=$(grep -nE "$pattern" "$@" /dev/null) || return 0
  fail "$sentence:" "$found"
}

# may_include FOLDER ALLOWED: files of FOLDER include, of our folders, itself and ALLOWED (separated by |) only.
may_include() {
  local folder=$1 allowed=$2 part others=''
  for part in mesh param remesh coder metrics experiments cli python; do
    [[ "|$folder|$allowed|" == *"|$part|"* ]] || others+="${others:+|}$part"
  done
  refuse "$folder may include $allowed only" "^ *# *include *\"($others)/" "$folder"/**/*.h "$folder"/**/*.cpp
}

# rooms FOLDER ROOM...: the rooms of FOLDER from the ground up. None includes one that stands behind it in the list, nor a
# file of FOLDER itself other than those in `ground`; every room of FOLDER is in the list; none is over 2,000 lines.
rooms() {
  local folder=$1 room lines index listed=" "
  shift
  local -a order=("$@")
  for index in "${!order[@]}"; do
    room=${order[index]}
    listed+="$room "
    local above='' part
    for part in "${order[@]:index+1}"; do above+="${above:+|}$part"; done
    [ -z "$above" ] || refuse "$folder/$room may not include the rooms above it" \
      "^ *# *include *\"$folder/($above)/" "$folder/$room"/**/*.h "$folder/$room"/**/*.cpp
    refuse "$folder/$room may not include the front door of $folder" \
      "^ *# *include *\"$folder/(parameterize|curve_job)\.h\"" "$folder/$room"/**/*.h "$folder/$room"/**/*.cpp
    lines=$(cat "$folder/$room"/*.h "$folder/$room"/*.cpp | wc -l)
    [ "$lines" -le 2000 ] || fail "$folder/$room has $lines lines; a room has 2,000 at most"
  done
  for room in "$folder"/*/; do
    room=$(basename "$room")
    local -a sources=("$folder/$room"/*.cpp)
    [ ${#sources[@]} -eq 0 ] || [[ "$listed" == *" $room "* ]] || fail "$folder/$room is no room of the list in this test"
  done
}

# tested FOLDER: every header of FOLDER is included by a test that holds it to an answer of its own.
tested() {
  local header included
  included=$(grep -ho '^ *# *include *"[^"]*"' tests/**/*.cpp tests/**/*.h)
  for header in "$1"/**/*.h; do
    [[ "$included" == *"\"$header\""* ]] || fail "no test includes $header: hold it to an answer known by hand"
  done
}

may_include mesh ''
may_include param 'mesh'
may_include remesh 'param|mesh'
may_include coder 'remesh|mesh'
may_include metrics 'param|mesh'
may_include experiments 'mesh|param|remesh|coder|metrics'
may_include cli 'mesh|param|remesh|coder|metrics|experiments'
may_include python 'mesh|param|remesh|coder|metrics|experiments'
rooms mesh files features nearest
rooms param map atlas linear refined energy removal simplify reinsert corners baselines creases stages
rooms remesh filters normal displaced scalar
rooms coder displaced
rooms experiments output external figures cells base curve plot store sweep check play report
refuse 'the coder knows the semi-regular mesh only, not the remesher' '"remesh/(remesh|param)' coder/**/*.h coder/**/*.cpp
refuse 'metrics and remesh know the result of a parameterization only, not the parameterizer' \
  '^ *# *include *"param/([^/]*|[^m/][^/]*/[^/]*)\.h"' metrics/**/*.h metrics/**/*.cpp remesh/**/*.h remesh/**/*.cpp
refuse 'a heavy library belongs into one .cpp' \
  '^ *# *include *<(CLI|boost|draco|OpenMesh|sqlite3|toml\+\+|tbb|png|xxhash)' {mesh,param,remesh,coder,metrics,experiments,cli}/**/*.h
for folder in param coder remesh metrics; do tested $folder; done
exit $((failures > 0))
