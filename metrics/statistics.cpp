#include "metrics/statistics.h"

#include <algorithm>

namespace gsp {

namespace {

double quantile(const std::vector<Weighted>& sorted, double total, double share) {
  double below = 0.0;
  for (const Weighted& w : sorted) {
    below += w.weight;
    if (below >= share * total) return w.value;
  }
  return sorted.back().value;
}

}  // namespace

Statistics statistics(std::vector<Weighted> values) {
  std::erase_if(values, [](const Weighted& w) { return !(w.weight > 0.0); });
  if (values.empty()) return {};
  std::stable_sort(values.begin(), values.end(),
                   [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  double total = 0.0, sum = 0.0;
  for (const Weighted& w : values) {
    total += w.weight;
    sum += w.weight * w.value;
  }
  Statistics result;
  result.minimum = values.front().value;
  result.mean = sum / total;
  result.p05 = quantile(values, total, 0.05);
  result.median = quantile(values, total, 0.5);
  result.p95 = quantile(values, total, 0.95);
  result.p99 = quantile(values, total, 0.99);
  result.maximum = values.back().value;
  return result;
}

}  // namespace gsp
