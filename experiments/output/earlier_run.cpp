#include "experiments/output/earlier_run.h"

#include <algorithm>
#include <filesystem>

namespace gsp {

void remove_stale(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& made) {
  for (const std::string& name : names) {
    const std::string path = folder + "/" + name;
    std::error_code ignored;
    if (std::find(made.begin(), made.end(), path) == made.end()) std::filesystem::remove(path, ignored);
  }
}

}  // namespace gsp
