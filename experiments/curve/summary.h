#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/curve.h"
#include "experiments/curve/rate_curve.h"
#include "metrics/bd_rate.h"

namespace gsp {

/// PSNR levels of the table of sizes, and the one at which sizes are compared.
inline constexpr double kTableLevelsDb[] = {50.0, 55.0, 60.0, 65.0, 70.0, 75.0};
inline constexpr double kRatioLevelDb = 65.0;
/// Curves are compared from this size, and as long as no curve is within the margin of its own remeshing ceiling.
inline constexpr double kCompareFromBytes = 1024.0;
inline constexpr double kCeilingMarginDb = 10.0;

/// The points of one curve: those of a method, or of one cell of a sweep.
struct CurveSeries {
  std::string name;
  std::vector<CurvePoint> points;
};

/// One method on one model.
struct MethodSummary {
  std::string method;  ///< name of the series
  int base_vertices = 0, base_faces = 0, level = 0;
  std::string positions;  ///< of the remesh: fitted, sampled or closest; empty for the anchors
  std::string coder;      ///< `coder_name` of the mode; empty for the anchors
  /// -20·log10(remeshing error), infinite where the remesh is exact; empty for the anchors, which have none.
  std::optional<double> ceiling_db;
  std::optional<double> exact_from_bytes;       ///< the size from which on the curve is exact
  std::vector<std::optional<double>> bytes_at;  ///< at kTableLevelsDb
  std::optional<Gain> gain;                     ///< of the first method over this one; empty for the first itself
  /// Bjøntegaard deltas of the first method (test) over this one (anchor), under both ceilings less kCeilingMarginDb;
  /// empty for the first itself, and with the reason in `no_bd` where the curves cannot be compared.
  std::optional<BdResult> bd;
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

/// False for the row of `kDracoLossless`, which says from where on no curve can win.
bool on_a_curve(const CurvePoint& point);

/// The curve that points make: the upper envelope of those on a curve.
RateCurve envelope_of(const std::vector<CurvePoint>& points);

/// PSNR of the uncoded remesh, infinite where that is exact; empty for anchors, which have none.
std::optional<double> ceiling_db(const std::vector<CurvePoint>& points);

/// The points of finite PSNR as `bd_compare` takes them, with the remesh's ceiling where there is one.
BdCurve bd_curve(const std::vector<CurvePoint>& points);

/// What the curve of a point is called: its method, with " mode=fixed" for streams of that mode, as labels of a sweep
/// have it.
std::string curve_name(const CurvePoint& point);

/// One series a name, in the order of their first points.
std::vector<CurveSeries> curves_of(const std::vector<CurvePoint>& points);

/// Summary of the curves of one model.
CurveSummary summarize(const std::string& model, const std::vector<CurveSeries>& curves);

/// Means over the models of what the first method gains over another; empty where no model has it.
struct MeanGain {
  std::optional<double> gain_db, bd_rate;  ///< dB; per cent
  int gain_models = 0, bd_models = 0;      ///< how many models have them
};
MeanGain mean_gain_over(const std::vector<CurveSummary>& summaries, const std::string& method);

/// The table for people, with the definition of every number in it.
void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries);

}  // namespace gsp
