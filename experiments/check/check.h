#pragma once

#include <string>
#include <vector>

#include "experiments/check/baseline.h"

namespace gsp {

enum class Verdict { Regressed, Changed, Improved, Added };
const char* verdict_name(Verdict verdict);

/// One thing that moved by more than it may.
struct Movement {
  std::string model, label;
  std::string what;           ///< number, time, "bd_rate", "option gamma", "row"
  std::string before, after;  ///< as text, "-" where there is none
  std::string allowed;        ///< the tolerance as text
  Verdict verdict = Verdict::Regressed;

  /// True where it makes the check fail: all but improvements and new rows.
  bool fails() const { return verdict == Verdict::Regressed || verdict == Verdict::Changed; }
};

struct CheckResult {
  std::vector<Movement> moved;
  std::vector<BaselineRow> rows;  ///< of the baseline, all of which were looked for
  int compared = 0;               ///< numbers and times
  int without_bd = 0;             ///< rows whose curve lies too near to its ceiling for a BD-rate
  bool passed() const;
};

struct CheckOptions {
  bool times = true;
};

/// Holds a run to a baseline: rows are found by model and label; every number against its tolerance or what chance
/// explains, whichever is more, the curve by its BD-rate over the baseline's, times in units of the reference task. The
/// deviations of the baseline's replicates say what chance explains, for as many replicates as the run has: of 20
/// checks of a program that has not changed one may fail. A row that is gone, fails, or is made by other options or of
/// another surface fails the check, and so does a check that compared no number; a row or number that is new does not.
/// Infinite decibels are equal to each other and better than any others.
CheckResult check(const Baseline& baseline, const Baseline& run, const CheckOptions& options);

/// The result as JUnit XML, one test case a row.
std::string junit_report(const CheckResult& result, const std::string& recipe);

}  // namespace gsp
