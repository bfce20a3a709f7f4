#pragma once

#include <memory>

#include "remesh/filters/filter.h"

namespace gsp {

/// The quadrature-mirror high-pass of the progressive geometry coder (Khodakovsky, Schröder, Sweldens 2000), from the
/// edges of the coarse level, centred on the vertices that they insert. Loop's mask with signs alternating, 19 taps on
/// a regular lattice. Beside irregular vertices and boundaries the taps that do not exist are left out, and the zero
/// sum of an edge's taps is restored on the even ones. Edges of boundaries and creases take the cubic spline's mask; no
/// other detail moves a crease, and one between two creases its own vertex alone, so that its coarse points and details
/// are a transform of its own. `mirror_symmetric`: the mean of the two signings that are possible, which is the same
/// seen from either side of the edge and has 11 taps, all on the edge's line and the two beside it.
std::unique_ptr<Filter> loop_high_pass(const SubdivisionLevel& coarse, bool mirror_symmetric = false);

}  // namespace gsp
