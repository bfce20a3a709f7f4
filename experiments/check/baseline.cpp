#include "experiments/check/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/curve/summary.h"
#include "experiments/output/decibels.h"
#include "experiments/output/quoting.h"
#include "experiments/store/json_file.h"
#include "experiments/version.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr const char* kTime = "time";
constexpr const char* kPsnr = "psnr_db";

// At its budgets, or at 256, 512, 1024, ...; a size beyond the whole stream has the whole stream's.
std::vector<std::size_t> rates(const StoredCell& cell, const RateCurve& curve) {
  if (!cell.options.budgets.empty()) return cell.options.budgets;
  std::vector<std::size_t> sizes;
  for (std::size_t bytes = 256; !curve.empty() && static_cast<double>(bytes) < curve.back().bytes; bytes *= 2)
    sizes.push_back(bytes);
  return sizes;
}

BaselineRow row_of(const StoredCell& cell) {
  BaselineRow row;
  // As JSON gives them back: it holds no bytes that are no UTF-8.
  row.model = printable(cell.model);
  row.label = printable(cell.label);
  row.cause = cell.cause;
  row.surface = cell.surface;
  for (const Axis& axis : axes())
    if (axis.applies_to(cell.options.method)) row.options[axis.name] = to_string(axis.get(cell.options));
  for (const Quantity& quantity : quantities())
    if (const auto value = cell.number(quantity.name)) row.numbers[quantity.name] = *value;
  const std::vector<CurvePoint> points = cell.points();
  row.curve = envelope_of(points);
  row.ceiling_db = ceiling_db(points);
  for (std::size_t bytes : rates(cell, row.curve)) {
    if (row.curve.empty() || static_cast<double>(bytes) < row.curve.front().bytes) continue;
    row.numbers[fmt::format("{} at {} bytes", kPsnr, bytes)] =
        psnr_at(row.curve, static_cast<double>(bytes)).value_or(row.curve.back().psnr_db);
  }
  for (const StageResult& stage : cell.stages)
    if (stage.reference_seconds > 0.0 && !stage.failed())
      row.times[fmt::format("{} {}", kTime, stage_name(stage.kind))] = stage.cpu_seconds / stage.reference_seconds;
  return row;
}

const Json& entry(const Json& j, const char* key) {
  if (!j.is_object() || !j.contains(key))
    throw Error(Cause::Malformed, std::string("it lacks \"") + key + "\", which gsp baseline writes");
  return j.at(key);
}

template <class T>
T value(const Json& j, const char* key) {
  const Json& found = entry(j, key);
  try {
    return found.get<T>();
  } catch (const Json::exception&) {
    throw Error(Cause::Malformed, std::string("\"") + key + "\" is of another kind than gsp baseline writes");
  }
}

// Infinite decibels are null, as JSON has no infinity; 0 stands for no ceiling.
Json db_json(double db) { return std::isfinite(db) ? Json(db) : Json(); }
double db_of(const Json& j) { return j.is_null() ? std::numeric_limits<double>::infinity() : j.get<double>(); }

Json numbers_json(const std::map<std::string, double>& numbers) {
  Json json = Json::object();
  for (const auto& [name, value] : numbers) json[name] = db_json(value);
  return json;
}

Json row_json(const BaselineRow& row) {
  Json curve = Json::array();
  for (const RatePoint& point : row.curve) curve.push_back({point.bytes, db_json(point.psnr_db)});
  Json json = {{"model", row.model}, {"label", row.label}, {"options", row.options}, {"cause", row.cause}};
  if (!row.surface.empty()) json["surface"] = row.surface;
  json.update({{"numbers", numbers_json(row.numbers)}, {"times", row.times}});
  put_db(json, "ceiling_db", row.ceiling_db.value_or(0.0));
  json["curve"] = curve;
  if (exact_from(row.curve)) json["curve_null"] = kExactReason;
  return json;
}

BaselineRow row_from(const Json& j) {
  BaselineRow row;
  row.model = value<std::string>(j, "model");
  row.label = value<std::string>(j, "label");
  row.options = value<std::map<std::string, std::string>>(j, "options");
  row.cause = value<std::string>(j, "cause");
  if (j.contains("surface")) row.surface = value<std::string>(j, "surface");
  for (const auto& [name, number] : entry(j, "numbers").items()) row.numbers[name] = db_of(number);
  row.times = value<std::map<std::string, double>>(j, "times");
  if (const double ceiling = db_of(entry(j, "ceiling_db")); ceiling > 0.0) row.ceiling_db = ceiling;
  for (const Json& point : entry(j, "curve")) row.curve.push_back({point.at(0).get<double>(), db_of(point.at(1))});
  return row;
}

Baseline baseline_from(const Json& j) {
  Baseline baseline;
  if (value<int>(j, "gsp_baseline") != kFormat) throw Error(Cause::Malformed, "it is of another format");
  baseline.recipe = value<std::string>(j, "recipe");
  baseline.version = value<std::string>(j, "version");
  for (const auto& [name, tolerance] : entry(j, "tolerances").items())
    baseline.tolerances[name] = {value<double>(tolerance, "absolute"), value<double>(tolerance, "relative")};
  for (const Json& row : entry(j, "rows")) baseline.rows.push_back(row_from(row));
  return baseline;
}

}  // namespace

const std::vector<Quantity>& quantities() {
  using enum Direction;
  // The numbers depend on nothing but the input and the program, up to the last bits that mathematical libraries differ
  // in; what an iteration makes of those stays well under a thousandth.
  constexpr Tolerance kExact{0.0, 0.0}, kRounding{0.0, 1e-3};
  static const std::vector<Quantity> all = {
      {kPsnr, HigherIsBetter, {0.02, 0.0}},
      {"bd_rate", LowerIsBetter, {0.5, 0.0}},
      // Under 1e-12 it is rounding, which is not the same on all machines.
      {"remesh_error", LowerIsBetter, {1e-12, 2e-3}},
      {"stream_bytes", LowerIsBetter, {0.0, 2e-3}},
      {"flipped_faces", LowerIsBetter, kExact},
      {"wrong_angle_vertices", LowerIsBetter, kExact},
      {"base_vertices", MayNotChange, kExact},
      {"base_faces", MayNotChange, kExact},
      {"level", MayNotChange, kExact},
      {"vertices_added", LowerIsBetter, kExact},
      {"anisotropy_mean", LowerIsBetter, kRounding},
      {"anisotropy_p95", LowerIsBetter, kRounding},
      {"area_symmetric_mean", LowerIsBetter, kRounding},
      {"l2_stretch", LowerIsBetter, kRounding},
      {"smoothness_inside", LowerIsBetter, kRounding},
      {"smoothness_across", LowerIsBetter, kRounding},
      {"smoothness_at_corner", LowerIsBetter, kRounding},
      // Ratios to the reference task; caches and the load of a machine move them by a third, so twice is a finding.
      {kTime, LowerIsBetter, {20.0, 1.0}},
  };
  return all;
}

const Quantity& quantity_of(const std::string& number) {
  const std::string name = number.substr(0, number.find(' '));
  for (const Quantity& quantity : quantities())
    if (name == quantity.name) return quantity;
  throw Error(Cause::Malformed, "a baseline of an unknown quantity " + name);
}

Baseline baseline_of(const std::string& recipe, const std::vector<StoredCell>& cells) {
  Baseline baseline;
  baseline.recipe = recipe;
  baseline.version = version();
  for (const Quantity& quantity : quantities()) baseline.tolerances[quantity.name] = quantity.tolerance;
  for (const StoredCell& cell : cells)
    if (cell.status != CellStatus::Waiting) baseline.rows.push_back(row_of(cell));
  return baseline;
}

void write_baseline(const std::string& path, const Baseline& baseline) {
  Json tolerances = Json::object(), rows = Json::array();
  for (const auto& [name, tolerance] : baseline.tolerances)
    tolerances[name] = {{"absolute", tolerance.absolute}, {"relative", tolerance.relative}};
  for (const BaselineRow& row : baseline.rows) rows.push_back(row_json(row));
  write_json(path, {{"gsp_baseline", kFormat},
                    {"recipe", baseline.recipe},
                    {"version", baseline.version},
                    {"tolerances", tolerances},
                    {"rows", rows}});
}

Baseline read_baseline(const std::string& path) {
  const Json json = read_json(path);
  try {
    return baseline_from(json);
  } catch (const Error& error) {
    throw error.within(path);
  } catch (const Json::exception&) {
    throw Error(Cause::Malformed, path + ": a number is of another kind than gsp baseline writes");
  }
}

}  // namespace gsp
