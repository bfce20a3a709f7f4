#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/rate_curve.h"
#include "experiments/curve/series.h"
#include "metrics/bd_rate.h"
#include "metrics/bootstrap.h"

namespace gsp {

/// PSNR levels of the table of sizes, and the one at which sizes are compared.
inline constexpr double kTableLevelsDb[] = {50.0, 55.0, 60.0, 65.0, 70.0, 75.0};
inline constexpr double kRatioLevelDb = 65.0;
/// Curves are compared from this size, and as long as no curve is within the margin of its own remeshing ceiling.
inline constexpr double kCompareFromBytes = 1024.0;
inline constexpr double kCeilingMarginDb = 10.0;

/// One method on one model. Numbers are means over its replicates.
struct MethodSummary {
  std::string method;  ///< name of the series
  int replicates = 1;
  int base_vertices = 0, base_faces = 0, level = 0;  ///< of the first replicate
  std::string positions;  ///< of the remesh: fitted, sampled or closest; empty for the anchors
  std::string coder;      ///< `coder_name` of the mode; empty for the anchors
  /// -20·log10(remeshing error), infinite where a remesh is exact; empty for the anchors, which have none.
  std::optional<double> ceiling_db;
  std::optional<double> exact_from_bytes;       ///< the size from which on all replicates are exact
  std::vector<std::optional<double>> bytes_at;  ///< at kTableLevelsDb, where all replicates reach it: geometric mean
  std::optional<Gain> gain;                     ///< of the first method over this one; empty for the first itself
  std::optional<MeanInterval> gain_interval;    ///< dB; empty for a single replicate
  std::vector<double> gains;                    ///< dB, of the pairs of replicates that have one
  /// Bjøntegaard deltas of the first method (test) over this one (anchor), under both ceilings less kCeilingMarginDb;
  /// empty for the first itself, and with the reason in `no_bd` where the curves cannot be compared. Of replicates the
  /// rates' geometric mean (`mean_percent`), and the range that all share.
  std::optional<BdResult> bd;
  std::optional<MeanInterval> bd_interval;  ///< per cent; empty for a single replicate
  std::vector<double> log_rates;            ///< `log_rate` of the pairs of replicates that have a BD-rate
  std::string no_bd;
  std::optional<double> bytes_ratio;          ///< this method's bytes over the first's, at kRatioLevelDb
  std::optional<std::size_t> lossless_bytes;  ///< at which it codes the input without loss, where it has such a row
};

struct CurveSummary {
  std::string model;
  std::string failure;                 ///< why the model has no curve, or not all of it; empty where all is well
  std::string cause;                   ///< `cause_name` of the failure
  std::vector<MethodSummary> methods;  ///< in the order of the points; the first is compared with the others
};

/// Summary of the curves of one model.
CurveSummary summarize(const std::string& model, const std::vector<CurveSeries>& curves);

/// A mean over models and their replicates.
struct ModelsMean {
  double value = 0.0;
  int models = 0;      ///< that have the number
  int replicates = 1;  ///< of the model with the fewest
  // Both are empty where a model has one replicate only.
  std::optional<MeanInterval> of_surfaces;  ///< about all surfaces, of which the models are taken to be a sample
  std::optional<MeanInterval> of_models;    ///< about these models: what chance alone does
};

/// What the first method gains over another; empty where no model has it.
struct MeanGain {
  std::optional<ModelsMean> gain_db;  ///< arithmetic mean
  std::optional<ModelsMean> bd_rate;  ///< per cent, `mean_percent`
};
/// The names of the series that the first is compared with, over all models.
std::vector<std::string> compared_methods(const std::vector<CurveSummary>& summaries);
MeanGain mean_gain_over(const std::vector<CurveSummary>& summaries, const std::string& method);

/// A BD-rate in per cent as the logarithm of bytes over bytes, of which means are taken: half the bytes and twice as
/// many cancel out.
double log_rate(double percent);

/// The geometric mean of bytes over bytes, by groups of `log_rate`s, in per cent; its interval with it.
MeanEstimate mean_percent(const std::vector<std::vector<double>>& log_rates, const BootstrapOptions& options = {});

/// The table for people, with the definition of every number in it.
void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries);

}  // namespace gsp
