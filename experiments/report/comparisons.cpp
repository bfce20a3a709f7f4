#include "experiments/report/comparisons.h"

#include <algorithm>

namespace gsp {

namespace {

Comparison compare(const std::string& model, const CurveSeries& reference, const CurveSeries& series) {
  Comparison result;
  result.model = model;
  result.label = series.name;
  if (of_another_model(series.runs.begin()->second)) result.note = kNoComparison;
  for (const auto& [replicate, ours, theirs] : paired_runs(reference, series)) try {
      const BdResult bd = bd_compare(bd_curve(*ours), bd_curve(*theirs), {});
      result.log_rates[replicate] = log_rate(bd.rate.value);
      if (result.note.empty()) result.note = bd.rate.warning;
    } catch (const Error& error) {
      result.note = error.what();
    }
  if (result.log_rates.empty()) return result;
  std::vector<double> rates;
  for (const auto& [replicate, rate] : result.log_rates) rates.push_back(rate);
  const MeanEstimate mean = mean_percent({rates});
  result.bd_rate = mean.mean;
  result.interval = mean.interval;
  return result;
}

const std::map<int, double>* rates_of(const std::vector<Comparison>& all, const std::string& model,
                                      const std::string& label) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Comparison& c) { return c.model == model && c.label == label; });
  return found == all.end() || found->log_rates.empty() ? nullptr : &found->log_rates;
}

// The differences of the replicates that both have.
std::vector<double> differences(const std::map<int, double>& rates, const std::map<int, double>& others) {
  std::vector<double> result;
  for (const auto& [replicate, rate] : rates)
    if (const auto other = others.find(replicate); other != others.end()) result.push_back(rate - other->second);
  return result;
}

}  // namespace

std::vector<Comparison> comparisons_with(const Run& run, const std::string& reference) {
  std::vector<Comparison> all;
  for (const StoredModel& model : run.models) {
    const std::vector<CurveSeries> curves = run.curves(model.name);
    const auto base =
        std::find_if(curves.begin(), curves.end(), [&](const CurveSeries& c) { return c.name == reference; });
    if (base == curves.end()) continue;
    for (const CurveSeries& curve : curves)
      if (curve.name != reference) all.push_back(compare(model.name, *base, curve));
  }
  return all;
}

std::optional<Standing> standing(const std::vector<Comparison>& comparisons, const std::string& label,
                                 const std::string& against, double confidence) {
  const std::string& named = label.empty() ? against : label;
  std::vector<std::vector<double>> groups;
  for (const Comparison& c : comparisons) {
    if (c.label != named || c.log_rates.empty()) continue;
    std::map<int, double> zero;
    for (const auto& [replicate, rate] : c.log_rates) zero[replicate] = 0.0;
    const auto* rates = label.empty() ? &zero : &c.log_rates;
    const auto* others = against.empty() ? &zero : rates_of(comparisons, c.model, against);
    if (!others) continue;
    if (std::vector<double> group = differences(*rates, *others); !group.empty()) groups.push_back(std::move(group));
  }
  if (groups.empty()) return std::nullopt;
  const MeanEstimate mean = mean_percent(groups, {.confidence = confidence});
  Standing result{label, mean.mean, mean.interval, static_cast<int>(groups.size()),
                  static_cast<int>(groups.front().size())};
  for (const auto& group : groups) result.replicates = std::min(result.replicates, static_cast<int>(group.size()));
  if (result.replicates == 1) result.interval.reset();
  return result;
}

}  // namespace gsp
