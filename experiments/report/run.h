#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/curve/summary.h"
#include "experiments/store/store.h"

namespace gsp {

/// What is reported on: the models and cells of one recipe, however they were computed.
struct Run {
  std::string name;  ///< of the recipe, or of the folder
  std::vector<StoredModel> models;
  std::vector<StoredCell> cells;
  std::map<std::string, double> paper_errors;  ///< remeshing errors of the paper's Table 1, by names of its models

  /// Null where no model has the name.
  const StoredModel* model(const std::string& name) const;
  /// The paper's remeshing error for a model; empty for what is none of its models.
  std::optional<double> paper_error(const std::string& model) const;
  /// Labels of the cells in the order of their first ones.
  std::vector<std::string> labels() const;
  /// The curves of a model's cells that are done, by their labels.
  std::vector<CurveSeries> curves(const std::string& model) const;
};

/// Reads a store of `gsp sweep` (a recipe of it; empty stands for the latest), or the folder that `gsp curve` made,
/// whose models have no surface and whose cells no artefacts but the removal costs. Throws Error(CannotOpen) where the
/// folder is neither, and what `Store` and `read_curve_csv` throw.
Run read_run(const std::string& folder, const std::string& recipe);

}  // namespace gsp
