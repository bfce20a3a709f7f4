#pragma once

#include <vector>

#include "cli/print.h"
#include "experiments/curve/summary.h"

namespace gsp::cli {

/// Summaries of models as JSON: an array with the model's methods, and its error where it has one.
Json summaries_report(const std::vector<CurveSummary>& summaries);

/// The means over the models of what the first method gains over each other, with their intervals.
Json means_report(const std::vector<CurveSummary>& summaries);

}  // namespace gsp::cli
