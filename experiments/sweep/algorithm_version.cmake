# Run at every build: writes OUTPUT, which holds a hash of the sources of each stage, where it has changed.
set(experiments experiments/curve/anchor_curves.cpp experiments/curve/external_curves.cpp experiments/curve/map_numbers.cpp experiments/curve/meter.cpp
    experiments/curve/rate_curve.cpp experiments/curve/stages.cpp experiments/external/run_tool.cpp experiments/sweep/stage_runner.cpp)
# The base by rate is judged by the whole chain.
set(parameterize_parts mesh param metrics remesh coder experiments/base)
set(remesh_parts mesh param remesh metrics)
set(encode_parts mesh remesh coder)
set(measure_parts mesh remesh coder metrics)

foreach(stage parameterize remesh encode measure)
  set(files "")
  foreach(part ${${stage}_parts})
    file(GLOB_RECURSE sources RELATIVE ${SOURCE} ${SOURCE}/${part}/*.h ${SOURCE}/${part}/*.cpp)
    list(APPEND files ${sources})
  endforeach()
  list(SORT files)
  set(all "${BUILD_OPTIONS}")
  foreach(file ${files} ${experiments})
    file(SHA256 ${SOURCE}/${file} hash)
    string(APPEND all "${file} ${hash}\n")
  endforeach()
  string(SHA256 hash "${all}")
  string(SUBSTRING ${hash} 0 16 hash)
  string(APPEND table "  if (name == \"${stage}\") return \"${hash}\";\n")
endforeach()

set(text "#include \"experiments/sweep/algorithm_version.h\"

namespace gsp {

const char* algorithm_version(StageKind kind) {
  const std::string name = stage_name(kind);
${table}  return \"\";
}

}  // namespace gsp
")
file(WRITE ${OUTPUT}.new "${text}")
configure_file(${OUTPUT}.new ${OUTPUT} COPYONLY)
