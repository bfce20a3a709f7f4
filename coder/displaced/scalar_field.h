#pragma once

#include <vector>

#include "coder/displaced/scalar_forest.h"
#include "coder/wavelet_transform.h"
#include "remesh/filters/displacement.h"

namespace gsp {

/// Displacements and their wavelet coefficients, by node of a forest: along the normals by any wavelet, across the
/// boundary by the four-point rule that Butterfly has there.
class ScalarField {
 public:
  /// `levels`: from the base to the finest; kept by reference, as is `forest`, which is theirs.
  ScalarField(const std::vector<SubdivisionLevel>& levels, const ScalarForest& forest, Wavelet wavelet);

  /// #N coefficients. O(V). Throws Error(SolverFailed).
  std::vector<double> analysis(const Displacements& displacements) const;
  /// The inverse, by operations that IEEE 754 fixes. O(V).
  Displacements synthesis(const std::vector<double>& coefficients) const;

  /// #N factors that make equal coefficients move the surface by about equal amounts in RMS: the square root of the
  /// area of the control mesh's surface that a coefficient acts on, over that of a vertex of `stream_level`; a quarter
  /// of it across boundaries, where displacements act on a strip. `control`: #B. `area_level`, at most the finest:
  /// where areas are taken; finer ones are a quarter each. The same bits on every machine. O(V).
  std::vector<double> weights(const std::vector<Vec3>& control, int area_level, int stream_level) const;

 private:
  const std::vector<SubdivisionLevel>& levels_;
  const ScalarForest& forest_;
  WaveletTransform along_, across_;
  double base_weight_;  ///< of a scaling function over a wavelet's
};

}  // namespace gsp
