#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/store/stored_cell.h"

namespace gsp {

/// A folder with results: `results.sqlite` (write-ahead log) and the files it names, under `artefacts/` by the hash of
/// their content. It may hold the cells of several recipes, which share what they have in common. Reading is safe while
/// a sweep writes, from any number of processes; on network file systems only where a single one has it open.
/// Any call throws Error(Malformed) where the database is damaged or of another schema, Error(CannotWrite) where it may
/// not be written.
class Store {
 public:
  /// Opens what `gsp sweep --store` made, to be read: nothing in the folder changes, and it may be one that cannot be
  /// written. Throws Error(CannotOpen) where there is no store in the folder, or it may not be read.
  static Store open(const std::string& folder);
  /// The same to be written, made where there is none. Only while its `FolderLock` is held.
  static Store create(const std::string& folder);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  const std::string& folder() const { return folder_; }

  /// Names of the recipes that were swept into it, the latest first.
  std::vector<std::string> recipes() const;
  /// Models and cells of a recipe in its order; an empty name stands for the latest.
  /// Throws Error(BadOption) where the store does not know the recipe.
  std::vector<StoredModel> models(const std::string& recipe = {}) const;
  std::vector<StoredCell> cells(const std::string& recipe = {}) const;
  /// The same as it was planned, paths relative to the folder.
  Plan plan(const std::string& recipe = {}) const;

  // For the sweep alone.
  /// Replaces the models and cells of a recipe, which becomes the latest. Results stay.
  void replace_plan(const Plan& plan);
  /// Adds or replaces results, all or none.
  void put(const std::vector<StageResult>& results);
  /// The stages of those keys that have run.
  std::map<std::string, StageResult> results() const;
  /// Forgets a stage, so that it runs again.
  void erase(const std::vector<std::string>& keys);

 private:
  Store(std::string folder, bool create);
  std::string folder_;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsp
