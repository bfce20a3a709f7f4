#pragma once

#include <optional>
#include <string>
#include <vector>

#include "param/parameterize.h"

namespace gsp {

/// Costs of removals at about the same size of the complex, times the vertices that remain. Ω sums areas of a total of
/// 1 over ever fewer and larger stars, so it grows with their size; the product does not, and shows how good they are.
struct CostBin {
  double remaining = 0.0;  ///< geometric mean
  double quality = 0.0;    ///< triangle shape and area dispersion
  double metric = 0.0;     ///< metric distortion
};

/// The cost of the simplification with the paper's three stages (§3.1.1, figure 5d).
struct CostCurve {
  std::vector<CostBin> bins;  ///< from the whole mesh to the base
  /// Vertices that remain where the first stage, which corrects ill-shaped triangles of the input, gives way to the
  /// slow ascent: the break of the two lines that fit the logarithms best before the third stage. Empty with too few
  /// bins.
  std::optional<double> second_stage;
  /// Where metric distortion dominates, as the automatic size of the base decides it; empty where the base was reached
  /// before.
  std::optional<double> third_stage;
};

CostCurve cost_curve(const std::vector<OmegaRecord>& record);

/// The gnuplot program of NAME.png and NAME.svg: the cost and its two parts over the vertices that remain, the stages
/// and the automatic stop marked. `cost` has bins.
std::string cost_script(const std::string& name, const std::string& title, const CostCurve& cost);

/// What the stages are and where the third begins, as half a sentence.
std::string cost_in_words(const CostCurve& cost);

/// Reads what `write_omega_csv` wrote. Throws Error: CannotOpen; Malformed with the line.
std::vector<OmegaRecord> read_omega_csv(const std::string& path);

}  // namespace gsp
