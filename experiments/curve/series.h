#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/curve.h"
#include "experiments/curve/rate_curve.h"
#include "metrics/bd_rate.h"

namespace gsp {

using CurvePoints = std::vector<CurvePoint>;

/// What carries one name on one model: the curve of a method or of one setting of a sweep, once for each replicate.
struct CurveSeries {
  std::string name;
  std::map<int, CurvePoints> runs;  ///< by replicate; none is without points
};

/// What the curve of a point is called: its method, with " kind=displaced" or another that is not parametric and
/// " mode=fixed" for streams of that mode, as labels of a sweep have it.
std::string curve_name(const CurvePoint& point);

/// One series a name, in the order of their first points.
std::vector<CurveSeries> curves_of(const CurvePoints& points);

/// Adds a run to the series of its name, which is made where it is missing. Points may be none: then nothing is added.
void add_run(std::vector<CurveSeries>& curves, const std::string& name, int replicate, CurvePoints points);

/// False for the row of `kDracoLossless`, which says from where on no curve can win.
bool on_a_curve(const CurvePoint& point);

/// Why such points are in no comparison.
inline constexpr const char* kNoComparison = "its points are of another model";
/// Whether the points were measured on another model than the rows name.
bool of_another_model(const CurvePoints& points);

/// The curve that points make: the upper envelope of those on a curve.
RateCurve envelope_of(const CurvePoints& points);

/// PSNR of the uncoded remesh, infinite where that is exact; empty for anchors, which have none.
std::optional<double> ceiling_db(const CurvePoints& points);
/// Its mean over the runs; infinite where one of them is exact, empty where one of them has none.
std::optional<double> ceiling_db(const CurveSeries& series);

/// The size from which on all runs are exact; empty where one of them never is.
std::optional<double> exact_from(const CurveSeries& series);

/// The points of finite PSNR as `bd_compare` takes them, with the remesh's ceiling where there is one.
BdCurve bd_curve(const CurvePoints& points);

/// The runs of two series that are to be held against each other: those of the same replicate, since they stand on one
/// base. A series with one run, as that of an anchor, goes with each run of the other. None where either is of another
/// model.
struct PairedRuns {
  int replicate;  ///< of the series that has several
  const CurvePoints* first;
  const CurvePoints* second;
};
std::vector<PairedRuns> paired_runs(const CurveSeries& first, const CurveSeries& second);

/// What the runs of a series reach at one size.
struct SpreadPoint {
  double bytes = 0.0;
  double mean_db = 0.0;
  double lowest_db = 0.0, highest_db = 0.0;
};

/// Mean and extremes of the runs' curves, at every size that one of them has and all of them cover; their points where
/// there is one run. A size that is exact in some of them alone has no mean and is left out. Empty where the runs have
/// no size in common.
std::vector<SpreadPoint> spread_of(const CurveSeries& series);

}  // namespace gsp
