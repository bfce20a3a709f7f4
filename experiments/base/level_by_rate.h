#pragma once

#include "mesh/progress.h"
#include "param/map/parameterization.h"
#include "remesh/remesh_options.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A remesh whose automatic level is chosen by rate: the one of `remesh`, and finer ones, of 2^20 faces at most, as
/// long as 16 KB of the stream come within 4 dB of the remesh itself, and the mean PSNR of 1, 2, 4, 8 and 16 KB of
/// lifted Butterfly grows. A stream that stays farther below its remesh has no use for a finer one (bench/README.md,
/// "The level by rate"). That takes an encoding and six distances of 10,000 samples a level. Levels that are given, and
/// kinds other than parametric, are `remesh`'s. The same bits for any number of threads. `progress` notes a finer
/// level. Throws what `remesh` throws.
SemiregularMesh remesh_by_rate(const Parameterization& map, RemeshOptions options, Progress& progress);

}  // namespace gsp
