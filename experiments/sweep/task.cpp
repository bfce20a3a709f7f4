#include "experiments/sweep/task.h"

#include <nlohmann/json.hpp>

#include "experiments/output/profile_json.h"
#include "experiments/store/json_file.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

Json result_json(const StageResult& r) {
  Json points = Json::array();
  for (const CurvePoint& p : r.points) points.push_back(measured_json(p));
  return {{"key", r.key},
          {"kind", stage_name(r.kind)},
          {"input", r.input},
          {"options", r.options},
          {"version", r.version},
          {"cause", r.cause},
          {"failure", r.failure},
          {"numbers", r.numbers},
          {"artefacts", r.artefacts},
          {"points", points},
          {"seconds", r.seconds},
          {"cpu_seconds", r.cpu_seconds},
          {"steps", profile_json(r.steps)},
          {"reference_seconds", r.reference_seconds}};
}

StageResult result_of(const Json& j) {
  StageResult r;
  r.key = j.at("key").get<std::string>();
  r.kind = stage_of(j.at("kind").get<std::string>());
  r.input = j.at("input").get<std::string>();
  r.options = j.at("options").get<std::string>();
  r.version = j.at("version").get<std::string>();
  r.cause = j.at("cause").get<std::string>();
  r.failure = j.at("failure").get<std::string>();
  r.numbers = j.at("numbers").get<std::map<std::string, double>>();
  r.artefacts = j.at("artefacts").get<std::map<std::string, std::string>>();
  for (const Json& point : j.at("points")) r.points.push_back(measured_point(point));
  r.seconds = j.at("seconds").get<double>();
  r.cpu_seconds = j.at("cpu_seconds").get<double>();
  if (j.contains("steps")) r.steps = profile_of_json(j.at("steps"));  // earlier versions wrote none
  r.reference_seconds = j.at("reference_seconds").get<double>();
  return r;
}

Json cell_json(const PlannedCell& cell) {
  Json keys = Json::object();
  for (const auto& [kind, key] : cell.keys) keys[stage_name(kind)] = key;
  return {{"model", cell.model}, {"label", cell.label}, {"options", options_json(cell.options)}, {"keys", keys}};
}

PlannedCell cell_of(const Json& j) {
  PlannedCell cell;
  cell.model = j.at("model").get<std::string>();
  cell.label = j.at("label").get<std::string>();
  cell.options = options_from_json(j.at("options").get<std::string>());
  for (const auto& [kind, key] : j.at("keys").items()) cell.keys[stage_of(kind)] = key.get<std::string>();
  return cell;
}

template <class Read>
auto read_as(const std::string& path, Read read) {
  const Json json = read_json(path);
  try {
    return read(json);
  } catch (const Json::exception& error) {
    throw Error(Cause::Malformed, path + ": " + error.what());
  }
}

}  // namespace

void write_task(const std::string& path, const Task& task) {
  Json cells = Json::array(), done = Json::array();
  for (const PlannedCell& cell : task.cells) cells.push_back(cell_json(cell));
  for (const auto& [key, result] : task.done) done.push_back(result_json(result));
  write_json(path, {{"surface_key", task.surface_key}, {"surface", task.surface}, {"cells", cells}, {"done", done}});
}

Task read_task(const std::string& path) {
  return read_as(path, [](const Json& j) {
    Task task;
    task.surface_key = j.at("surface_key").get<std::string>();
    task.surface = j.at("surface").get<std::string>();
    for (const Json& cell : j.at("cells")) task.cells.push_back(cell_of(cell));
    for (const Json& done : j.at("done")) {
      StageResult result = result_of(done);
      task.done[result.key] = std::move(result);
    }
    return task;
  });
}

void write_result(const std::string& path, const StageResult& result) { write_json(path, result_json(result)); }

StageResult read_result(const std::string& path) {
  return read_as(path, [](const Json& j) { return result_of(j); });
}

std::string inbox_folder(const std::string& store) { return store + "/inbox"; }

}  // namespace gsp
