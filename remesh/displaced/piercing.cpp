#include "remesh/displaced/piercing.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "mesh/fixed_order.h"

namespace gsp {

Piercing::Piercing(const Mesh& surface) : surface_(surface), across_(surface.faces.size(), {-1, -1, -1}) {
  std::unordered_map<std::uint64_t, int> sides;
  sides.reserve(3 * surface.faces.size());
  const auto key = [](int from, int to) {
    return (static_cast<std::uint64_t>(from) << 32) | static_cast<std::uint32_t>(to);
  };
  for (int f = 0; f < surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) sides[key(surface.faces[f][k], surface.faces[f][(k + 1) % 3])] = 3 * f + k;
  for (int f = 0; f < surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto twin = sides.find(key(surface.faces[f][(k + 1) % 3], surface.faces[f][k]));
      if (twin != sides.end()) across_[f][k] = twin->second / 3;
    }
}

std::optional<Piercing::Hit> Piercing::walk(int face, const Vec3& origin, const Vec3& direction) const {
  constexpr int kMostFaces = 300;
  for (int step = 0; step < kMostFaces && face >= 0; ++step) {
    const Triangle& t = surface_.faces[face];
    std::array<Vec3, 3> p;
    for (int k = 0; k < 3; ++k) p[k] = surface_.positions[t[k]] - origin;
    // Twice the areas, seen along the line, of the triangles between it and each side.
    std::array<double, 3> area;
    for (int k = 0; k < 3; ++k) area[k] = dot(direction, cross(p[k], p[(k + 1) % 3]));
    const double whole = area[0] + area[1] + area[2];
    if (!(whole > 0.0)) return std::nullopt;
    const int least = static_cast<int>(std::min_element(area.begin(), area.end()) - area.begin());
    if (area[least] >= -1e-12 * whole) {
      const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
      return Hit{face, dot(normal, p[0]) / dot(normal, direction)};
    }
    face = across_[face][least];
  }
  return std::nullopt;
}

}  // namespace gsp
