#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "mesh/topology.h"

namespace gsp {

std::vector<int> first_at_same_position(const std::vector<Vec3>& positions) {
  struct Entry {
    std::array<std::uint64_t, 3> bits;
    int index;
  };
  std::vector<Entry> entries;
  entries.reserve(positions.size());
  for (const Vec3& p : positions) {
    Entry entry{{}, static_cast<int>(entries.size())};
    for (int k = 0; k < 3; ++k) entry.bits[k] = Eigen::numext::bit_cast<std::uint64_t>(p[k] + 0.0);  // -0 + 0 is +0
    entries.push_back(entry);
  }
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.bits, a.index) < std::tie(b.bits, b.index); });
  std::vector<int> first(positions.size());
  for (std::size_t i = 0, group = 0; i < entries.size(); ++i) {
    if (entries[i].bits != entries[group].bits) group = i;
    first[entries[i].index] = entries[group].index;
  }
  return first;
}

namespace {

/// Positions that were kept, by cubes of twice the distance that they lie apart: few of them are in one, and eight
/// cubes hold all that are near a position. Cubes are found in a sorted list, which no input makes slow.
class KeptPositions {
 public:
  KeptPositions(const std::vector<Vec3>& positions, double distance) : positions_(positions), distance_(distance) {
    for (const Vec3& p : positions)
      if (p.allFinite()) cubes_.push_back(cube(p));
    std::sort(cubes_.begin(), cubes_.end());
    cubes_.erase(std::unique(cubes_.begin(), cubes_.end()), cubes_.end());
    last_.resize(cubes_.size(), -1);
    before_.resize(positions.size(), -1);
  }

  /// The smallest index of those within the distance; otherwise v, which is kept.
  int find_or_keep(int v) {
    const Vec3& p = positions_[v];
    if (!p.allFinite()) return v;
    const Cube own = cube(p);
    int found = v;
    for (int side = 0; side < 8; ++side) {
      Cube near = own;
      for (int k = 0; k < 3; ++k)
        if (side >> k & 1) near[k] += p[k] / (2.0 * distance_) - own[k] < 0.5 ? -1.0 : 1.0;
      const auto place = std::lower_bound(cubes_.begin(), cubes_.end(), near);
      if (place == cubes_.end() || *place != near) continue;
      for (int kept = last_[place - cubes_.begin()]; kept >= 0; kept = before_[kept])
        if (kept < found && (positions_[kept] - p).norm() <= distance_) found = kept;
    }
    if (found == v) {
      int& last = last_[std::lower_bound(cubes_.begin(), cubes_.end(), own) - cubes_.begin()];
      before_[v] = last;
      last = v;
    }
    return found;
  }

 private:
  using Cube = std::array<double, 3>;

  Cube cube(const Vec3& p) const {
    Cube c;
    for (int k = 0; k < 3; ++k) c[k] = std::floor(p[k] / (2.0 * distance_));
    return c;
  }

  const std::vector<Vec3>& positions_;
  double distance_;
  std::vector<Cube> cubes_;
  std::vector<int> last_;    ///< #cubes, the position kept last there, or -1
  std::vector<int> before_;  ///< #V, the one kept before it in the same cube, or -1
};

}  // namespace

std::vector<int> first_within(const std::vector<Vec3>& positions, double distance) {
  KeptPositions kept(positions, distance);
  std::vector<int> first(positions.size());
  for (int v = 0; v < static_cast<int>(first.size()); ++v) first[v] = kept.find_or_keep(v);
  return first;
}

WeldedMesh weld(const Mesh& mesh, const std::vector<int>& first) {
  require_indices(mesh);
  std::vector<int> left(first.size());
  WeldedMesh welded;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (first[v] == v) {
      left[v] = welded.mesh.vertex_count();
      welded.mesh.positions.push_back(mesh.positions[v]);
      welded.vertices.push_back(v);
    } else {
      left[v] = left[first[v]];
    }
  }
  welded.mesh.faces.reserve(mesh.faces.size());
  for (const Triangle& t : mesh.faces) welded.mesh.faces.push_back({left[t[0]], left[t[1]], left[t[2]]});
  return welded;
}

WeldedMesh weld(const Mesh& mesh, double share) {
  const double distance = share * bounding_box_diagonal(mesh);
  const bool exact = !(distance > 0.0) || !std::isfinite(distance);
  return weld(mesh, exact ? first_at_same_position(mesh.positions) : first_within(mesh.positions, distance));
}

}  // namespace gsp
