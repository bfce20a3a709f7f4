#include "experiments/sweep/external_version.h"

#include <map>

#include "experiments/external/run_tool.h"
#include "experiments/store/content_hash.h"

namespace gsp {

std::string external_version(const ExternalTool& tool) {
  std::string version = printed_version(tool);
  for (const std::string& file : files_of(tool)) {
    try {
      version += ' ' + file_hash(file);
    } catch (const Error&) {
      version += " unreadable";
    }
  }
  return version;
}

Recipe with_external_versions(Recipe recipe) {
  std::map<std::string, std::string> versions;
  for (RecipeBlock& block : recipe.blocks)
    for (CellOptions& cell : block.cells) {
      if (!cell.external) continue;
      const auto [found, added] = versions.try_emplace(external_json(*cell.external));
      if (added) found->second = external_version(*cell.external);
      cell.external->version = found->second;
    }
  return recipe;
}

}  // namespace gsp
