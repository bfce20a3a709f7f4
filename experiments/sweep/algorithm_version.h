#pragma once

#include "experiments/cells/cell_options.h"

namespace gsp {

/// Version of a stage's algorithm: a hash, made at build time, of the sources that the stage is made of and of the
/// build options that change its numbers. So no result of another program is ever taken for this one's, and nobody has
/// to remember to raise a number; the price is that a mere change of a comment computes anew.
const char* algorithm_version(StageKind kind);

}  // namespace gsp
