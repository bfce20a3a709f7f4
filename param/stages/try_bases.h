#pragma once

#include <memory>

#include "mesh/progress.h"
#include "param/simplify/simplify.h"

namespace gsp {

/// A simplification, and the options with which `simplify` makes its base again.
struct TriedBase {
  ParameterizeOptions options;
  SimplifyResult simplified;
};

/// Of `options.tries` bases the one whose smoothed coarsest level has the least energy of distortion by area, the
/// first of equals. The first is that of one try alone; each other has prices moved by a chance of its own, as a
/// replicate's are, and, where the stop is automatic, the first one's number of vertices. They are smoothed with the
/// default options, whatever the method, so that all methods stand on the same. Each further try costs a
/// simplification and the smoothing of a coarsest level. Deterministic. Throws Error(Cancelled).
TriedBase best_base(const std::shared_ptr<const Surface>& surface, const ParameterizeOptions& options, int coarsest,
                    Progress& progress);

}  // namespace gsp
