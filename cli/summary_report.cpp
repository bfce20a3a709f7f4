#include "cli/summary_report.h"

#include <nlohmann/json.hpp>

#include "experiments/output/decibels.h"

namespace gsp::cli {

namespace {

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

// [low, high] at 95%, null where there is one run.
Json interval(const std::optional<MeanInterval>& interval) {
  return interval ? Json{interval->low, interval->high} : Json();
}

Json mean_report(const ModelsMean& mean) {
  return {{"mean", mean.value},
          {"interval_of_surfaces", interval(mean.of_surfaces)},
          {"interval_of_these_models", interval(mean.of_models)},
          {"models", mean.models},
          {"replicates", mean.replicates}};
}

Json average_report(const BdAverage& average, const char* unit) {
  Json report = {
      {unit, average.value}, {"from", average.from}, {"to", average.to}, {"overlap_share", average.overlap_share}};
  if (average.small_overlap) report["warning"] = average.warning;
  return report;
}

Json method_report(const MethodSummary& m) {
  Json bytes_at = Json::object();
  for (std::size_t i = 0; i < m.bytes_at.size(); ++i)
    bytes_at[std::to_string(static_cast<int>(kTableLevelsDb[i])) + "_db"] = optional(m.bytes_at[i]);
  Json report = {{"method", m.method}, {"replicates", m.replicates}, {"bytes_at", bytes_at}};
  if (m.base_vertices > 0)
    report.update({{"base_vertices", m.base_vertices},
                   {"base_faces", m.base_faces},
                   {"level", m.level},
                   {"positions", m.positions},
                   {"coder", m.coder}});
  if (m.ceiling_db) put_db(report, "ceiling_db", m.ceiling_db);
  if (m.exact_from_bytes) report["exact_from_bytes"] = *m.exact_from_bytes;
  if (m.gain)
    report["gain"] = {{"mean_db", m.gain->mean_db},
                      {"interval_db", interval(m.gain_interval)},
                      {"replicates_db", m.gains},
                      {"from_bytes", m.gain->from_bytes},
                      {"to_bytes", m.gain->to_bytes}};
  if (m.bd) {
    report["bd_rate"] = average_report(m.bd->rate, "percent");
    report["bd_rate"]["interval_percent"] = interval(m.bd_interval);
    report["bd_psnr"] = average_report(m.bd->psnr, "db");
  } else if (!m.no_bd.empty()) {
    report["no_bd"] = m.no_bd;
  }
  if (m.bytes_ratio) report["bytes_ratio"] = *m.bytes_ratio;
  if (m.lossless_bytes) report["lossless_bytes"] = *m.lossless_bytes;
  return report;
}

}  // namespace

Json summaries_report(const std::vector<CurveSummary>& summaries) {
  Json models = Json::array();
  for (const CurveSummary& summary : summaries) {
    Json methods = Json::array();
    for (const MethodSummary& m : summary.methods) methods.push_back(method_report(m));
    Json model = {{"model", summary.model}, {"methods", methods}};
    if (!summary.failure.empty()) model["error"] = {{"cause", summary.cause}, {"message", summary.failure}};
    models.push_back(model);
  }
  return models;
}

Json means_report(const std::vector<CurveSummary>& summaries) {
  Json means = Json::array();
  for (const std::string& other : compared_methods(summaries)) {
    const MeanGain mean = mean_gain_over(summaries, other);
    Json report = {{"over", other}};
    if (mean.gain_db) report["gain_db"] = mean_report(*mean.gain_db);
    if (mean.bd_rate) report["bd_rate_percent"] = mean_report(*mean.bd_rate);
    means.push_back(report);
  }
  return means;
}

}  // namespace gsp::cli
