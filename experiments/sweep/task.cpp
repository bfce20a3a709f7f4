#include "experiments/sweep/task.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "mesh/atomic_file.h"
#include "mesh/read_file.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }
// A surface that is met exactly has an infinite PSNR, which JSON cannot hold.
double number(const Json& value) {
  return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

Json point_json(const CurvePoint& p) {
  return {p.coder, p.bytes,     p.bits_per_vertex, p.faces,   p.rms_forward,       p.rms_backward,
          p.rms,   p.hausdorff, finite(p.psnr_db), p.samples, p.standard_error_db, p.seed};
}

CurvePoint point_of(const Json& j) {
  CurvePoint p;
  p.coder = j.at(0).get<std::string>();
  p.bytes = j.at(1).get<std::size_t>();
  p.bits_per_vertex = j.at(2).get<double>();
  p.faces = j.at(3).get<int>();
  p.rms_forward = j.at(4).get<double>();
  p.rms_backward = j.at(5).get<double>();
  p.rms = j.at(6).get<double>();
  p.hausdorff = j.at(7).get<double>();
  p.psnr_db = number(j.at(8));
  p.samples = j.at(9).get<std::size_t>();
  p.standard_error_db = j.at(10).get<double>();
  p.seed = j.at(11).get<std::uint64_t>();
  return p;
}

Json result_json(const StageResult& r) {
  Json points = Json::array();
  for (const CurvePoint& p : r.points) points.push_back(point_json(p));
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
  for (const Json& point : j.at("points")) r.points.push_back(point_of(point));
  r.seconds = j.at("seconds").get<double>();
  r.cpu_seconds = j.at("cpu_seconds").get<double>();
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

void write_json(const std::string& path, const Json& json) {
  AtomicFile file(path);
  // Sentences of failures may name files, whose names may hold any bytes.
  file.stream() << json.dump(1, ' ', false, Json::error_handler_t::replace) << '\n';
  file.commit();
}

template <class Read>
auto read_json(const std::string& path, Read read) {
  try {
    return read(Json::parse(read_file(path)));
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
  return read_json(path, [](const Json& j) {
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
  return read_json(path, [](const Json& j) { return result_of(j); });
}

std::string inbox_folder(const std::string& store) { return store + "/inbox"; }

}  // namespace gsp
