#pragma once

#include <memory>

#include "remesh/filters/filter.h"

namespace gsp {

/// Modified Butterfly interpolation, from the vertices of a level to those of the next (Zorin, Schröder, Sweldens 1996;
/// algorithms.md §5): old vertices stay. A wing that a boundary takes away is put where a parallelogram has it;
/// boundary edges take the four-point rule.
std::unique_ptr<Filter> butterfly_low_pass(const SubdivisionLevel& coarse);

}  // namespace gsp
