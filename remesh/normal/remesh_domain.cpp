#include "remesh/normal/remesh_domain.h"

#include <algorithm>

namespace gsp {

RemeshDomain::RemeshDomain(const BaseComplex& base, const std::vector<SubdivisionLevel>& levels)
    : base_(base), levels_(levels), sides_(levels[0].edges.size()) {
  const SubdivisionLevel& level = levels[0];
  for (int e = 0; e < level.edge_count(); ++e) {
    const int face = level.edge_faces[e][0];
    const std::array<int, 3>& edges = level.face_edges[face];
    sides_[e] = 3 * face + static_cast<int>(std::find(edges.begin(), edges.end(), e) - edges.begin());
  }
}

Complex RemeshDomain::corner(int face, int k) const {
  const int vertex = connectivity().faces[face][k], chart = base_face(face);
  const int bases = levels_[0].vertex_count;
  if (vertex < bases) {
    const Triangle& t = base_.faces[chart];
    return kChartCorners[std::find(t.begin(), t.end(), vertex) - t.begin()].value();
  }
  const DomainVertex& v = vertices_[vertex - bases];
  return v.home == chart ? v.z : base_.across(v.side).apply(v.z);
}

Transition RemeshDomain::across(int edge, int face) const {
  const bool first = connectivity().edge_faces[edge][0] == face;
  return first || sides_[edge] < 0 ? Transition{} : base_.across(sides_[edge]);
}

std::vector<FacePiece> RemeshDomain::reach(int face) const {
  const int chart = base_face(face);
  if (level_ == 0) return {{chart, face, {}}};
  const int bases = levels_[0].vertex_count;
  const Triangle& t = connectivity().faces[face];
  // A base vertex lies in many charts. Above the base no face has more than one.
  const DomainVertex& start = vertices_[*std::max_element(t.begin(), t.end()) - bases];
  const Transition there = start.home == chart ? start.into : start.into * base_.across(start.side).inverse();
  std::array<Complex, 3> triangle = corners(face);
  for (Complex& z : triangle) z = there.apply(z);
  std::vector<FacePiece> pieces;
  develop_triangle(base_, face, start.chart, start.in_chart(), triangle, pieces);
  for (FacePiece& piece : pieces) piece.motion = piece.motion * there;
  return pieces;
}

void RemeshDomain::refine(std::vector<DomainVertex> inserted) {
  const SubdivisionLevel& coarse = levels_[level_];
  const SubdivisionLevel& fine = levels_[level_ + 1];
  std::vector<int> sides(fine.edges.size(), -1);
  for (int e = 0; e < fine.edge_count(); ++e) {
    const auto [low, high] = std::minmax(fine.edges[e][0], fine.edges[e][1]);
    if (low >= coarse.vertex_count) continue;
    // It is a half of a coarse edge: those inside a coarse face join two middles.
    const int whole = sides_[high - coarse.vertex_count];
    if (whole < 0) continue;
    const bool same_face = fine.edge_faces[e][0] >> (2 * (level_ + 1)) == whole / 3;
    sides[e] = same_face ? whole : base_.twins[whole];
  }
  vertices_.insert(vertices_.end(), std::make_move_iterator(inserted.begin()), std::make_move_iterator(inserted.end()));
  sides_ = std::move(sides);
  ++level_;
}

}  // namespace gsp
