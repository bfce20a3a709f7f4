#include "experiments/check/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/curve/summary.h"
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

Json row_json(const BaselineRow& row) {
  Json curve = Json::array();
  for (const RatePoint& point : row.curve) curve.push_back({point.bytes, point.psnr_db});
  return {{"model", row.model},     {"label", row.label}, {"options", row.options},       {"cause", row.cause},
          {"numbers", row.numbers}, {"times", row.times}, {"ceiling_db", row.ceiling_db}, {"curve", curve}};
}

BaselineRow row_from(const Json& j) {
  BaselineRow row;
  row.model = j.at("model").get<std::string>();
  row.label = j.at("label").get<std::string>();
  row.options = j.at("options").get<std::map<std::string, std::string>>();
  row.cause = j.at("cause").get<std::string>();
  row.numbers = j.at("numbers").get<std::map<std::string, double>>();
  row.times = j.at("times").get<std::map<std::string, double>>();
  row.ceiling_db = j.at("ceiling_db").get<double>();
  for (const Json& point : j.at("curve")) row.curve.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
  return row;
}

Baseline baseline_from(const Json& j) {
  Baseline baseline;
  if (j.at("gsp_baseline").get<int>() != kFormat) throw Error(Cause::Malformed, "a baseline of another format");
  baseline.recipe = j.at("recipe").get<std::string>();
  baseline.version = j.at("version").get<std::string>();
  for (const auto& [name, tolerance] : j.at("tolerances").items())
    baseline.tolerances[name] = {tolerance.at("absolute").get<double>(), tolerance.at("relative").get<double>()};
  for (const Json& row : j.at("rows")) baseline.rows.push_back(row_from(row));
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
      {"remesh_error", LowerIsBetter, {0.0, 2e-3}},
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
  } catch (const Json::exception& error) {
    throw Error(Cause::Malformed, path + ": " + error.what());
  }
}

}  // namespace gsp
