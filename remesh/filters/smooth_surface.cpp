#include "remesh/filters/smooth_surface.h"

#include <utility>

#include "remesh/filters/loop_limit.h"
#include "remesh/filters/loop_low_pass.h"

namespace gsp {

SmoothSurface smooth_surface(const std::vector<SubdivisionLevel>& levels, std::vector<Vec3> control) {
  for (std::size_t l = 0; l + 1 < levels.size(); ++l) {
    std::vector<Vec3> fine(levels[l + 1].vertex_count, Vec3::Zero());
    loop_low_pass(levels[l])->add(control.data(), fine.data());
    control = std::move(fine);
  }
  SmoothSurface surface;
  surface.points.assign(control.size(), Vec3::Zero());
  loop_limit_points(levels.back())->add(control.data(), surface.points.data());
  surface.normals = loop_limit_normals(levels.back(), control);
  surface.conormals = loop_limit_conormals(levels.back(), control, surface.normals);
  return surface;
}

}  // namespace gsp
