#pragma once

#include "coder/loop_filters.h"

namespace gsp {

/// Modified Butterfly interpolation as a matrix from the vertices of a level to those of the next (Zorin, Schröder,
/// Sweldens 1996; algorithms.md §5): old vertices stay. A wing that a boundary takes away is put where a parallelogram
/// has it; boundary edges take the four-point rule.
SparseMatrix butterfly_low_pass(const SubdivisionLevel& coarse);

/// #V by #E: what lifting takes off each old vertex for a detail on each edge, so that wavelets have no mean: half the
/// integral of the new vertex's scaling function over that of the old one's, 1/8 between regular vertices. Integrals are
/// taken in proportion to the faces around a vertex.
SparseMatrix butterfly_update(const SubdivisionLevel& coarse);

}  // namespace gsp
