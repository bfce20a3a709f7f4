#pragma once

#include <vector>

#include "metrics/distortion.h"
#include "metrics/picture.h"
#include "metrics/smoothness.h"

namespace gsp {

/// One measure of a map for pictures: #F values and the scale that shows them.
struct MapMeasure {
  PictureColumn column;
  ColourScale scale;  ///< gray without distortion, red for the worst 5% of the area
};

/// Names of the measures in the order of `map_measures`: anisotropy, area, stretch_l2, sorkine, smoothness.
std::vector<std::string> map_measure_names();

/// `d` and `s` are those of `map`. O(F).
std::vector<MapMeasure> map_measures(const Parameterization& map, const Distortion& d, const Smoothness& s);

}  // namespace gsp
