#pragma once

#include <memory>

#include "coder/filter.h"

namespace gsp {

/// Modified Butterfly interpolation, from the vertices of a level to those of the next (Zorin, Schröder, Sweldens 1996;
/// algorithms.md §5): old vertices stay. A wing that a boundary takes away is put where a parallelogram has it;
/// boundary edges take the four-point rule.
std::unique_ptr<Filter> butterfly_low_pass(const SubdivisionLevel& coarse);

/// From edges to old vertices: what lifting takes off each vertex for a detail on each edge, so that wavelets have no
/// mean: half the integral of the new vertex's scaling function over that of the old one's, 1/8 between regular
/// vertices. Integrals are taken in proportion to the faces around a vertex.
std::unique_ptr<Filter> butterfly_update(const SubdivisionLevel& coarse);

}  // namespace gsp
