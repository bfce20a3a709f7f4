#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve.h"
#include "experiments/rate_curve.h"

namespace gsp {

/// PSNR levels of the table of sizes, and the one at which sizes are compared.
inline constexpr double kTableLevelsDb[] = {50.0, 55.0, 60.0, 65.0, 70.0, 75.0};
inline constexpr double kRatioLevelDb = 65.0;
/// Curves are compared from this size, and as long as no curve is within the margin of its own remeshing ceiling.
inline constexpr double kCompareFromBytes = 1024.0;
inline constexpr double kCeilingMarginDb = 10.0;

/// One method on one model.
struct MethodSummary {
  std::string method;
  int base_vertices = 0, base_faces = 0, level = 0;
  double ceiling_db = 0.0;                      ///< -20·log10(remeshing error); 0 for the anchors, which have none
  std::vector<std::optional<double>> bytes_at;  ///< at kTableLevelsDb
  std::optional<Gain> gain;                     ///< of the first method over this one; empty for the first itself
  std::optional<double> bytes_ratio;            ///< this method's bytes over the first's, at kRatioLevelDb
};

struct CurveSummary {
  std::string model;
  std::string failure;                 ///< why the model has no curve, or not all of it; empty where all is well
  std::string cause;                   ///< `cause_name` of the failure
  std::vector<MethodSummary> methods;  ///< in the order of the points; the first is compared with the others
};

/// The curve that a method's points make: their upper envelope.
RateCurve method_curve(const std::vector<CurvePoint>& points, const std::string& method);

/// Names of the methods in the order of their first points.
std::vector<std::string> methods_of(const std::vector<CurvePoint>& points);

/// Summary of the points of one model.
CurveSummary summarize(const std::string& model, const std::vector<CurvePoint>& points);

/// Mean over the models of the gain over a method; empty where no model has one. `models` receives how many do.
std::optional<double> mean_gain_db(const std::vector<CurveSummary>& summaries, const std::string& method, int& models);

/// The table for people, with the definition of every number in it.
void print_summaries(std::ostream& out, const std::vector<CurveSummary>& summaries);

}  // namespace gsp
