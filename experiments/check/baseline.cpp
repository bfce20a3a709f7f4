#include "experiments/check/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "experiments/curve/summary.h"
#include "experiments/store/json_file.h"
#include "experiments/version.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;
constexpr const char* kTime = "time";
constexpr const char* kPsnr = "psnr_db";
constexpr const char* kBdRate = "bd_rate";

// At the cell's budgets, or at 256, 512, 1024, ...; a size beyond the whole stream has the whole stream's.
std::vector<std::size_t> rates(const StoredCell& cell, const RateCurve& curve) {
  if (!cell.options.budgets.empty()) return cell.options.budgets;
  std::vector<std::size_t> sizes;
  for (std::size_t bytes = 256; !curve.empty() && static_cast<double>(bytes) < curve.back().bytes; bytes *= 2)
    sizes.push_back(bytes);
  return sizes;
}

// Numbers of one cell by name.
std::map<std::string, double> numbers_of(const StoredCell& cell) {
  std::map<std::string, double> numbers;
  for (const Quantity& quantity : quantities())
    if (const auto value = cell.number(quantity.name)) numbers[quantity.name] = *value;
  const RateCurve curve = envelope_of(cell.points());
  for (std::size_t bytes : rates(cell, curve)) {
    if (curve.empty() || static_cast<double>(bytes) < curve.front().bytes) continue;
    numbers[fmt::format("{} at {} bytes", kPsnr, bytes)] =
        psnr_at(curve, static_cast<double>(bytes)).value_or(curve.back().psnr_db);
  }
  return numbers;
}

std::map<std::string, double> times_of(const StoredCell& cell) {
  std::map<std::string, double> times;
  for (const StageResult& stage : cell.stages)
    if (stage.reference_seconds > 0.0 && !stage.failed())
      times[fmt::format("{} {}", kTime, stage_name(stage.kind))] = stage.cpu_seconds / stage.reference_seconds;
  return times;
}

// The means of those numbers that all have; their deviations where these are not zero.
void average(const std::vector<std::map<std::string, double>>& all, std::map<std::string, double>& means,
             std::map<std::string, double>* deviations) {
  for (const auto& [name, value] : all.front()) {
    std::vector<double> values;
    for (const auto& numbers : all)
      if (const auto found = numbers.find(name); found != numbers.end()) values.push_back(found->second);
    if (values.size() < all.size()) continue;
    // The mean of equal values is that value to the last bit.
    const bool equal = std::all_of(values.begin(), values.end(), [&](double v) { return v == value; });
    means[name] = equal ? value : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    if (!equal && deviations) (*deviations)[name] = std::sqrt(sample_variance(values));
  }
}

// How far the curves of replicates lie from the mean one, as a standard deviation of BD-rates; 0 where they have none.
double bd_deviation(const CurveSeries& series, const BaselineRow& row) {
  std::vector<double> rates;
  for (const auto& [replicate, points] : series.runs) try {
      rates.push_back(bd_compare(bd_curve(row), bd_curve(points), {.ceiling_margin_db = kCeilingMarginDb}).rate.value);
    } catch (const Error&) {
      return 0.0;
    }
  return std::sqrt(sample_variance(rates));
}

// Of the cells of one label on one model.
BaselineRow row_of(const std::vector<const StoredCell*>& cells) {
  BaselineRow row;
  const StoredCell& first = *cells.front();
  row.model = first.model;
  row.label = first.label;
  row.replicates = static_cast<int>(cells.size());
  for (const Axis& axis : axes())
    if (!axis.repeats && axis.applies_to(first.options.method))
      row.options[axis.name] = to_string(axis.get(first.options));
  std::vector<std::map<std::string, double>> numbers, times;
  CurveSeries series{first.label, {}};
  for (const StoredCell* cell : cells) {
    if (row.cause.empty()) row.cause = cell->cause;
    numbers.push_back(numbers_of(*cell));
    times.push_back(times_of(*cell));
    if (CurvePoints points = cell->points(); !points.empty())
      series.runs[cell->options.parameterize.replicate] = std::move(points);
  }
  average(numbers, row.numbers, &row.deviations);
  average(times, row.times, nullptr);
  for (const SpreadPoint& point : spread_of(series)) row.curve.push_back({point.bytes, point.mean_db});
  row.ceiling_db = ceiling_db(series);
  if (row.replicates > 1)
    if (const double deviation = bd_deviation(series, row); deviation > 0.0) row.deviations[kBdRate] = deviation;
  return row;
}

Json row_json(const BaselineRow& row) {
  Json curve = Json::array();
  for (const RatePoint& point : row.curve) curve.push_back({point.bytes, point.psnr_db});
  return {
      {"model", row.model},           {"label", row.label},     {"options", row.options},       {"cause", row.cause},
      {"replicates", row.replicates}, {"numbers", row.numbers}, {"deviations", row.deviations}, {"times", row.times},
      {"ceiling_db", row.ceiling_db}, {"curve", curve}};
}

BaselineRow row_from(const Json& j) {
  BaselineRow row;
  row.model = j.at("model").get<std::string>();
  row.label = j.at("label").get<std::string>();
  row.options = j.at("options").get<std::map<std::string, std::string>>();
  row.cause = j.at("cause").get<std::string>();
  // Baselines of one run lack both.
  row.replicates = j.value("replicates", 1);
  row.deviations = j.value("deviations", std::map<std::string, double>());
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

BdCurve bd_curve(const BaselineRow& row) {
  BdCurve curve;
  for (const RatePoint& point : row.curve) curve.points.push_back({point.bytes, point.psnr_db});
  if (row.ceiling_db > 0.0) curve.ceiling_db = row.ceiling_db;
  return curve;
}

const std::vector<Quantity>& quantities() {
  using enum Direction;
  // The numbers depend on nothing but the input and the program, up to the last bits that mathematical libraries differ
  // in; what an iteration makes of those stays well under a thousandth.
  constexpr Tolerance kExact{0.0, 0.0}, kRounding{0.0, 1e-3};
  static const std::vector<Quantity> all = {
      {kPsnr, HigherIsBetter, {0.02, 0.0}},
      {kBdRate, LowerIsBetter, {0.5, 0.0}},
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
  std::vector<std::vector<const StoredCell*>> groups;
  std::map<std::pair<std::string, std::string>, std::size_t> places;
  for (const StoredCell& cell : cells) {
    if (cell.status == CellStatus::Waiting) continue;
    const auto [place, added] = places.try_emplace({cell.model, cell.label}, groups.size());
    if (added) groups.emplace_back();
    groups[place->second].push_back(&cell);
  }
  for (const auto& group : groups) baseline.rows.push_back(row_of(group));
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
