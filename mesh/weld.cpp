#include "mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <tuple>

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
    for (int k = 0; k < 3; ++k) entry.bits[k] = std::bit_cast<std::uint64_t>(p[k] + 0.0);  // -0 + 0 is +0
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

Mesh weld(const Mesh& mesh) {
  const std::vector<int> first = first_at_same_position(mesh.positions);
  std::vector<int> kept(first.size());
  Mesh welded;
  for (int v = 0; v < mesh.vertex_count(); ++v) {
    if (first[v] == v) {
      kept[v] = welded.vertex_count();
      welded.positions.push_back(mesh.positions[v]);
    } else {
      kept[v] = kept[first[v]];
    }
  }
  welded.faces.reserve(mesh.faces.size());
  for (const Triangle& t : mesh.faces) welded.faces.push_back({kept[t[0]], kept[t[1]], kept[t[2]]});
  return welded;
}

}  // namespace gsp
