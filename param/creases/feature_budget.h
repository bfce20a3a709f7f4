#pragma once

#include "mesh/export.h"
#include "mesh/features/features.h"
#include "param/options.h"

namespace GSP_PUBLIC gsp {

/// The features along which a surface is cut.
struct ChosenFeatures {
  FeatureEdges edges;
  int curves = 0;
  int given_way = 0;  ///< curves that were dropped
};

/// All features that the options ask for, whether the base has room for them or not. Throws as `choose_features`. O(F
/// log F).
FeatureEdges wanted_features(const Mesh& mesh, const ParameterizeOptions& options);

/// The least number of base vertices asked for with which none of these curves gives way.
int base_for_all(const std::vector<FeatureCurve>& curves);

/// Base vertices that curves need at least: their corners, and three on a closed one.
int corners_needed(const std::vector<FeatureCurve>& curves);

/// The features that the options ask for, as many as a base of that size has room for: the shortest and least sharp
/// curves give way first. Throws Error: BadOption, and for given features IndexOutOfRange, or Malformed where one is no
/// interior edge of the surface. O(F log F) for each tenth of the curves that gives way.
ChosenFeatures choose_features(const Mesh& mesh, const ParameterizeOptions& options);

}  // namespace gsp
