#pragma once

namespace gsp {

/// Loads UMFPACK and CHOLMOD, which bring OpenBLAS along, where that has not been done. The functions of theirs that
/// Eigen calls do it by themselves; who looks for OpenBLAS by name calls this first. Commands that solve nothing never
/// load them: OpenBLAS maps over 100 MB, and waits for ever where it cannot.
/// Throws Error(SolverFailed) where a library is missing, std::bad_alloc where memory is too short for them.
void load_suitesparse();

}  // namespace gsp
