#pragma once

#include <vector>

#include "mesh/export.h"

namespace GSP_PUBLIC gsp {

/// Weighted statistics of a quantity. Percentiles are values that occur: the least that holds that share of the weight.
struct Statistics {
  double minimum = 0.0;
  double mean = 0.0;
  double p05 = 0.0;
  double median = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double maximum = 0.0;
};

struct Weighted {
  double value, weight;
};

/// All zero where no weight is positive. O(n log n).
Statistics statistics(std::vector<Weighted> values);

}  // namespace gsp
