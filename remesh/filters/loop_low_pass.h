#pragma once

#include <memory>

#include "remesh/filters/filter.h"

namespace gsp {

/// Loop subdivision, from the vertices of a level to those of the next: smooth rules inside, the cubic spline's on
/// boundaries and creases, corners (VertexFan) fixed (algorithms.md §5; Loop 1987, Hoppe et al. 1994).
std::unique_ptr<Filter> loop_low_pass(const SubdivisionLevel& coarse);

/// Weight that a vertex inside keeps, whatever its valence: 5/8 at valence 6.
double loop_kept_weight(int valence);

}  // namespace gsp
