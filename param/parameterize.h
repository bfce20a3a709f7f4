#pragma once

#include <string>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"
#include "mesh/progress.h"
#include "param/creases/feature_budget.h"
#include "param/map/parameterization.h"
#include "param/options.h"

namespace GSP_PUBLIC gsp {

struct ParameterizeResult {
  Parameterization map;
  std::vector<OmegaRecord>
      omega;                    ///< a record a removal, and with an automatic base size that of the one it stopped at
  int flips_before_repair = 0;  ///< of the paper's solution with Objective::Linear; the other map never has any
  int relaxation_rounds = 0;
  int corners_moved = 0;
  int base_edges_flipped = 0;
  ChosenFeatures features;  ///< that have become creases of the base; none for the baselines
  int held_vertices = 0;    ///< kept back from the smooth solution, which would be folded there
};

/// Computes a globally smooth parameterization of a manifold surface, or a baseline. For Method::Gsp the result is
/// always valid in the sense of `check_map`, or it throws. Those of Method::MapsSmoothed and Hybrid may hold flipped
/// faces, as published. Throws Error: the refusals of topology.h, BadOption, InvalidMap, SolverFailed, Cancelled.
ParameterizeResult parameterize(const Mesh& mesh, const ParameterizeOptions& options, Progress& progress);

/// The same for several methods on one base complex: options.method is ignored.
std::vector<ParameterizeResult> parameterize_all(const Mesh& mesh, const std::vector<Method>& methods,
                                                 const ParameterizeOptions& options, Progress& progress);

/// Bytes of memory that `parameterize` and its program will hold at most: an estimate from the faces alone
/// (bench/README.md, "Memory", says how near it is and who needs more).
double parameterize_memory(const Mesh& mesh);

/// Writes remaining_vertices, shape, dispersion, metric, omega, one row per removal; where the base size is automatic
/// the last row is the removal that was not made, since it begins the third stage.
void write_omega_csv(const std::string& path, const std::vector<OmegaRecord>& record);

}  // namespace gsp
