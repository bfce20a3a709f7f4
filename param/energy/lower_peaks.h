#pragma once

#include <vector>

#include "param/energy/distortion_energy.h"

namespace gsp {

/// Lowers the energy one vertex at a time around the faces where it is highest, which a step of all vertices together
/// would have to stop short for. `x`: positions of a map free of folds, and of one when it returns. Serial, O(F) a
/// sweep.
void lower_peaks(const DistortionEnergy& energy, std::vector<double>& x);

}  // namespace gsp
