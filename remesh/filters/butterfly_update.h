#pragma once

#include <memory>

#include "remesh/filters/filter.h"

namespace gsp {

/// From edges to old vertices: what lifting takes off each vertex for a detail on each edge, so that wavelets have no
/// mean: half the integral of the new vertex's scaling function over that of the old one's, 1/8 between regular
/// vertices. Integrals are taken in proportion to the faces around a vertex. A
/// crease is lifted as a curve, by its own details alone: a quarter, and nothing at its corners and ends.
std::unique_ptr<Filter> butterfly_update(const SubdivisionLevel& coarse);

}  // namespace gsp
