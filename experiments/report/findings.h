#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/report/comparisons.h"
#include "experiments/report/run.h"

namespace gsp {

/// Per cent of bytes that the reference saves against a curve with this BD-rate over it; negative where it needs more.
double saving(double bd_rate);

/// What a run says.
struct Findings {
  std::string
      reference;  ///< label that the others are held against: of method gsp, with options nearest to the defaults
  std::vector<Comparison> comparisons;
  /// The answers, most important first: bytes against every other method; then, where options vary, which setting is
  /// best and by how much; then what is missing. With replicates each number has its 95% interval; what an interval
  /// does not tell apart is said to be so.
  std::vector<std::string> sentences;

  const Comparison* comparison(const std::string& model, const std::string& label) const;
  /// Mean BD-rate of a label against the reference over the models that have one; empty where none has.
  std::optional<Standing> mean(const std::string& label) const;
};

Findings findings(const Run& run);

}  // namespace gsp
