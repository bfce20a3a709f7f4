#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/report/run.h"

namespace gsp {

/// One curve of a model against the reference curve of that model.
struct Comparison {
  std::string model, label;
  /// Bytes at equal PSNR over those of the reference, in per cent less 100 (BD-rate, metrics/bd_rate.h, ceilings
  /// respected): more than 0 is worse than the reference. Empty where the curves cannot be compared.
  std::optional<double> bd_rate;
  std::string note;  ///< why not, or a warning
};

/// Per cent of bytes that the reference saves against a curve with this BD-rate over it; negative where it needs more.
double saving(double bd_rate);

/// What a run says.
struct Findings {
  std::string
      reference;  ///< label that the others are held against: of method gsp, with options nearest to the defaults
  std::vector<Comparison> comparisons;
  /// The answers, most important first: bytes against every other method; then, where options vary, which setting is
  /// best and by how much; then what is missing.
  std::vector<std::string> sentences;

  const Comparison* comparison(const std::string& model, const std::string& label) const;
  /// Mean BD-rate over the models that have one; empty where none has. `models` receives how many do.
  std::optional<double> mean_bd_rate(const std::string& label, int& models) const;
};

Findings findings(const Run& run);

}  // namespace gsp
