#include "experiments/check/baseline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

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

// The means of those numbers that all have; their deviations where these are not zero. Infinite decibels are in no
// mean: what is exact in some replicates alone is left out.
void average(const std::vector<std::map<std::string, double>>& all, std::map<std::string, double>& means,
             std::map<std::string, double>* deviations) {
  for (const auto& [name, value] : all.front()) {
    std::vector<double> values;
    for (const auto& numbers : all)
      if (const auto found = numbers.find(name); found != numbers.end()) values.push_back(found->second);
    if (values.size() < all.size()) continue;
    // The mean of equal values is that value to the last bit.
    const bool equal = std::all_of(values.begin(), values.end(), [&](double v) { return v == value; });
    if (!equal && !std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); })) continue;
    means[name] = equal ? value : std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
    if (!equal && deviations) (*deviations)[name] = std::sqrt(sample_variance(values));
  }
}

// How far the curves of replicates lie from the mean one: the standard deviation of the logarithms of BD-rates, in per
// cent, since those are what chance moves as much up as down; 0 where they have none.
double bd_deviation(const CurveSeries& series, const BaselineRow& row) {
  std::vector<double> rates;
  for (const auto& [replicate, points] : series.runs) try {
      const BdResult bd = bd_compare(bd_curve(row), bd_curve(points), {.ceiling_margin_db = kCeilingMarginDb});
      rates.push_back(100.0 * log_rate(bd.rate.value));
    } catch (const Error&) {
      return 0.0;
    }
  return std::sqrt(sample_variance(rates));
}

// Of the cells of one label on one model.
BaselineRow row_of(const std::vector<const StoredCell*>& cells) {
  BaselineRow row;
  const StoredCell& first = *cells.front();
  // As JSON gives them back: it holds no bytes that are no UTF-8.
  row.model = printable(first.model);
  row.label = printable(first.label);
  row.surface = first.surface;
  row.replicates = static_cast<int>(cells.size());
  for (const Axis& axis : axes())
    if (!axis.repeats && axis.applies_to(first.options)) row.options[axis.name] = to_string(axis.get(first.options));
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
  Json json = {{"model", row.model},
               {"label", row.label},
               {"options", row.options},
               {"cause", row.cause},
               {"replicates", row.replicates}};
  if (!row.surface.empty()) json["surface"] = row.surface;
  json.update({{"numbers", numbers_json(row.numbers)}, {"deviations", row.deviations}, {"times", row.times}});
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
  // Baselines of one run lack both.
  if (j.contains("replicates")) row.replicates = value<int>(j, "replicates");
  if (j.contains("deviations")) row.deviations = value<std::map<std::string, double>>(j, "deviations");
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

BdCurve bd_curve(const BaselineRow& row) {
  BdCurve curve;
  for (const RatePoint& point : finite_part(row.curve)) curve.points.push_back({point.bytes, point.psnr_db});
  if (row.ceiling_db) curve.ceiling_db = *row.ceiling_db;
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
  } catch (const Error& error) {
    throw error.within(path);
  } catch (const Json::exception&) {
    throw Error(Cause::Malformed, path + ": a number is of another kind than gsp baseline writes");
  }
}

}  // namespace gsp
