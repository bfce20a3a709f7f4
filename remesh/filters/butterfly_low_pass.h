#pragma once

#include <memory>

#include "remesh/filters/filter.h"

namespace gsp {

/// Modified Butterfly interpolation, from the vertices of a level to those of the next (Zorin, Schröder, Sweldens 1996;
/// algorithms.md §5): old vertices stay. A wing that a sharp edge takes away is put where a parallelogram has
/// it; boundaries and creases take the four-point rule, with an end beyond corners and darts that goes straight on.
std::unique_ptr<Filter> butterfly_low_pass(const SubdivisionLevel& coarse);

}  // namespace gsp
