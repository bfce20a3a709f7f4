#include "experiments/play/view_frame.h"

#include <nlohmann/json.hpp>

#include "experiments/figures/camera.h"
#include "experiments/figures/paint.h"
#include "experiments/figures/render.h"

namespace gsp {

namespace {

using Json = nlohmann::ordered_json;

Json triple(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

int level_within(const SemiregularMesh& mesh, long long most_faces) {
  return last_level_with(static_cast<std::int64_t>(mesh.base_faces.size()), most_faces, mesh.level);
}

Json view_frame(const Mesh& seen, const BaseComplex& base, const Eigen::AlignedBox3d& box, int level) {
  const Camera camera = make_camera(seen, {});
  Json colours = Json::array();
  for (const Colour& c : patch_colours(base)) {
    const Colour rgb = (255.0 * c).round();
    colours.push_back({static_cast<int>(rgb[0]), static_cast<int>(rgb[1]), static_cast<int>(rgb[2])});
  }
  return {{"level", level},
          {"outward", orientation(seen)},
          {"camera", {triple(camera.right), triple(camera.up), triple(camera.toward)}},
          {"low", triple(box.min())},
          {"high", triple(box.max())},
          {"patch_colours", colours}};
}

}  // namespace gsp
