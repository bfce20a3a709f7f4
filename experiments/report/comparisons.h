#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/report/run.h"
#include "metrics/bootstrap.h"

namespace gsp {

/// One curve of a model against the reference curve of that model.
struct Comparison {
  std::string model, label;
  /// Bytes at equal PSNR over those of the reference, in per cent less 100 (BD-rate, metrics/bd_rate.h, ceilings
  /// respected): more than 0 is worse than the reference. Of replicates the geometric mean (`mean_percent`). Empty
  /// where the curves cannot be compared.
  std::optional<double> bd_rate;
  std::optional<MeanInterval> interval;  ///< what chance does to it; empty for one run
  std::map<int, double> log_rates;       ///< `log_rate` of each pair of replicates that has a BD-rate
  std::string note;                      ///< why not, or a warning
};

/// All curves of all models against the series of that label. Models without it are left out.
std::vector<Comparison> comparisons_with(const Run& run, const std::string& reference);

/// A mean over models of what one label needs against another.
struct Standing {
  std::string label;
  double bd_rate = 0.0;  ///< per cent, `mean_percent` over models and replicates
  /// Of one model about chance, of several about all surfaces; empty where a model has one run.
  std::optional<MeanInterval> interval;
  int models = 0;
  int replicates = 0;  ///< of the model with the fewest
};

/// How a label stands against another, by their comparisons with one reference, paired by model and replicate: the
/// logarithms of their rates are subtracted. An empty label is the reference itself. Empty where no model has both.
/// `confidence`: of the interval.
std::optional<Standing> standing(const std::vector<Comparison>& comparisons, const std::string& label,
                                 const std::string& against, double confidence = 0.95);

}  // namespace gsp
