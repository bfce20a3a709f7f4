#pragma once

#include <optional>
#include <string>

#include "param/map/parameterization.h"

namespace gsp {

/// What `check_map` finds wrong with a map, as a sentence; nothing where it is valid.
std::optional<std::string> faults_of(const Parameterization& map);

/// Throws Error(InvalidMap). Its place is the face of `input` in which a point of its coordinates lies; none where
/// the point is not known. O(faces).
[[noreturn]] void refuse_map(const std::string& sentence, const std::optional<Vec3>& at, const Mesh& input);

/// Throws Error(InvalidMap) where a map is not valid. Its place is the face of `input` in which the first fault lies:
/// the surface as it was before edges were split, in the coordinates of the map's. O(faces).
void require_valid(const Parameterization& map, const Mesh& input);

}  // namespace gsp
