#include "param/map/development.h"

#include <algorithm>
#include <optional>

#include "mesh/halfedges.h"
#include "mesh/parallel.h"
#include "param/map/base_fan.h"
#include "param/map/lattice_motion.h"
#include "param/map/tolerances.h"

namespace gsp {

namespace {

using tolerance::kReach, tolerance::kSamePlace;
using Weights = std::array<double, 3>;

/// The piece of the base face beyond an edge of the one that `from` lies in.
FacePiece step_across(const BaseComplex& base, const FacePiece& from, int edge) {
  const int h = 3 * from.chart + edge;
  return {base.twins[h] / 3, from.face, base.across(h) * from.motion};
}

Complex centroid(const std::array<Complex, 3>& corners) { return (corners[0] + corners[1] + corners[2]) / 3.0; }

double depth(Complex z) {
  const Weights w = chart_barycentric(z);
  return std::min({w[0], w[1], w[2]});
}

/// A corner of the face that lies at the same place of the same chart, and is no base vertex: a walk from it is in the
/// right sector.
std::optional<Complex> anchor(const Parameterization& map, int face) {
  for (int k = 0; k < 3; ++k) {
    const int v = map.surface.faces[face][k];
    const Complex corner = map.face_corners[face][k];
    if (map.patch[v] != map.face_chart[face] || std::abs(map.position[v] - corner) > kSamePlace) continue;
    const Weights w = chart_barycentric(corner);
    if (std::max({w[0], w[1], w[2]}) < 1.0 - kSamePlace) return corner;
  }
  return std::nullopt;
}

FacePiece walk_to_centroid(const BaseComplex& base, const std::array<Complex, 3>& corners, const FacePiece& from,
                           Complex start) {
  const Complex goal = from.motion.apply(centroid(corners));
  const Arrival at = walk_straight(base, from.chart, from.motion.apply(start), goal);
  return {at.chart, from.face, at.change * from.motion};
}

/// Whether the triangle of the given weights reaches beyond `edge` of the chart's triangle through that edge itself.
bool crosses(const std::array<Weights, 3>& corners, int edge) {
  const int across = (edge + 2) % 3, along = (edge + 1) % 3;
  double low = 2.0, high = -1.0, farthest = 0.0;
  for (int k = 0; k < 3; ++k) {
    const Weights &p = corners[k], &q = corners[(k + 1) % 3];
    farthest = std::min(farthest, p[across]);
    if ((p[across] < 0.0) == (q[across] < 0.0)) continue;
    const double t = p[across] / (p[across] - q[across]);
    const double at = p[along] + t * (q[along] - p[along]);
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return farthest < -kReach && std::min(high, 1.0) - std::max(low, 0.0) > kReach;
}

bool same(const FacePiece& a, const FacePiece& b) { return a.chart == b.chart && a.motion == b.motion; }

/// Adds the pieces that a triangle reaches from `pieces.back()`, its first one.
void flood(const BaseComplex& base, const std::array<Complex, 3>& corners, std::vector<FacePiece>& pieces) {
  const std::size_t first = pieces.size() - 1;
  for (std::size_t at = first; at < pieces.size(); ++at) {
    const FacePiece here = pieces[at];
    std::array<Weights, 3> weights;
    for (int k = 0; k < 3; ++k) weights[k] = chart_barycentric(here.motion.apply(corners[k]));
    for (int edge = 0; edge < 3; ++edge) {
      if (base.twins[3 * here.chart + edge] < 0 || !crosses(weights, edge)) continue;
      const FacePiece there = step_across(base, here, edge);
      const auto known = [&](const FacePiece& p) { return same(p, there); };
      if (pieces.size() - first >= kMaxPieces || std::any_of(pieces.begin() + first, pieces.end(), known)) continue;
      pieces.push_back(there);
    }
  }
}

}  // namespace

Development::Development(const Parameterization& map) : map_(map) {
  std::vector<int> unplaced;
  for (int f = 0; f < map.surface.face_count(); ++f)
    if (!anchor(map, f) && depth(centroid(map.face_corners[f])) < 0.0) unplaced.push_back(f);
  if (!unplaced.empty()) place_beside_others(std::move(unplaced));
}

void Development::place_beside_others(std::vector<int> faces) {
  const Halfedges halfedges(map_.surface);
  std::vector<char> open(map_.surface.faces.size(), 0);
  for (int f : faces) open[f] = 1;
  std::vector<FacePiece> beside;
  // From faces that are placed into those that are not, in rounds, since such faces may touch.
  const auto place = [&](int f) {
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int twin = halfedges.twin[h];
      if (twin < 0 || open[twin / 3]) continue;
      const auto &here = map_.face_corners[f], &there = map_.face_corners[twin / 3];
      const Complex a = here[h % 3], b = here[Halfedges::next(h) % 3];
      const auto motion = lattice_motion_within(kSamePlace, a, b, there[Halfedges::next(twin) % 3], there[twin % 3]);
      if (!motion) continue;
      beside.clear();
      append(twin / 3, beside);
      const Complex middle = 0.5 * (a + b);
      const auto deepest = std::max_element(beside.begin(), beside.end(), [&](const FacePiece& p, const FacePiece& q) {
        return depth((p.motion * *motion).apply(middle)) < depth((q.motion * *motion).apply(middle));
      });
      centre_[f] = walk_to_centroid(map_.base, here, {deepest->chart, f, deepest->motion * *motion}, middle);
      open[f] = 0;
      return true;
    }
    return false;
  };
  for (std::size_t before = faces.size() + 1; faces.size() < before;) {
    before = faces.size();
    std::erase_if(faces, place);
  }
}

void Development::append(int face, std::vector<FacePiece>& pieces) const {
  const std::array<Complex, 3>& corners = map_.face_corners[face];
  const auto placed = centre_.find(face);
  if (placed == centre_.end()) {
    const Complex start = anchor(map_, face).value_or(chart_position(1.0 / 3.0, 1.0 / 3.0));
    return develop_triangle(map_.base, face, map_.face_chart[face], start, corners, pieces);
  }
  pieces.push_back(placed->second);
  flood(map_.base, corners, pieces);
}

void develop_triangle(const BaseComplex& base, int face, int chart, Complex start,
                      const std::array<Complex, 3>& corners, std::vector<FacePiece>& pieces) {
  pieces.push_back(walk_to_centroid(base, corners, {chart, face, {}}, start));
  flood(base, corners, pieces);
}

std::vector<std::vector<FacePiece>> pieces_by_chart(const Parameterization& map) {
  constexpr std::size_t kBlock = 4096;
  const std::size_t faces = map.surface.faces.size();
  const Development development(map);
  std::vector<std::vector<FacePiece>> blocks((faces + kBlock - 1) / kBlock);
  parallel_for(faces, kBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<FacePiece>& pieces = blocks[begin / kBlock];
    for (std::size_t f = begin; f < end; ++f) development.append(static_cast<int>(f), pieces);
  });
  std::vector<int> count(map.base.faces.size(), 0);
  for (const auto& block : blocks)
    for (const FacePiece& piece : block) ++count[piece.chart];
  std::vector<std::vector<FacePiece>> charts(map.base.faces.size());
  for (std::size_t c = 0; c < charts.size(); ++c) charts[c].reserve(count[c]);
  for (const auto& block : blocks)
    for (const FacePiece& piece : block) charts[piece.chart].push_back(piece);
  return charts;
}

}  // namespace gsp
