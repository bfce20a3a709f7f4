#!/bin/sh
# meshlab-iso.sh INPUT OUTPUT SAMPLING_RATE: MeshLab 2020.09's iso-parametrization and its remesh, without a screen. Its scripts must
# hold every parameter of a filter. With more than one OpenMP thread it never ends.
set -eu
script=$(mktemp --suffix=.mlx)
trap 'rm -f "$script"' EXIT
cat >"$script" <<XML
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Iso Parametrization: Main">
  <Param type="RichInt" name="targetAbstractMinFaceNum" value="150" description="" tooltip=""/>
  <Param type="RichInt" name="targetAbstractMaxFaceNum" value="200" description="" tooltip=""/>
  <Param type="RichEnum" name="stopCriteria" value="1" description="" tooltip="" enum_val0="Best Heuristic" enum_val1="Area + Angle" enum_val2="Regularity" enum_val3="L2" enum_cardinality="4"/>
  <Param type="RichInt" name="convergenceSpeed" value="1" description="" tooltip=""/>
  <Param type="RichBool" name="DoubleStep" value="true" description="" tooltip=""/>
  <Param type="RichString" name="AbsLoadName" value="" description="" tooltip=""/>
  <Param type="RichString" name="AbsSaveName" value="" description="" tooltip=""/>
 </filter>
 <filter name="Iso Parametrization Remeshing">
  <Param type="RichInt" name="SamplingRate" value="$3" description="" tooltip=""/>
 </filter>
</FilterScript>
XML
export OMP_NUM_THREADS=1
# It ends with status 0 even where it made nothing: then the next step finds no file.
xvfb-run -a meshlabserver -i "$1" -o "$2.torn.obj" -s "$script"
python3 "$(dirname "$0")/meshlab-stitch.py" "$2.torn.obj" "$2" "$3"
