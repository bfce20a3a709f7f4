#pragma once

#include <string>
#include <vector>

namespace gsp {

/// Removes what an earlier run left in a folder and the present one has not made again. `names`: of files below the
/// folder that a run may have made. `made`: paths with the folder, of the present one. What cannot be removed stays.
void remove_stale(const std::string& folder, const std::vector<std::string>& names,
                  const std::vector<std::string>& made);

}  // namespace gsp
