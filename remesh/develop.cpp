#include "remesh/develop.h"

#include <algorithm>
#include <optional>

#include "mesh/parallel.h"

namespace gsp {

namespace {

/// Reaching less far than this over an edge, or through a gap narrower than this, is rounding (chart units).
constexpr double kReach = 1e-12;
/// A vertex's position and the face's corner are the same point of the same chart up to this.
constexpr double kSamePlace = 1e-9;

using Weights = std::array<double, 3>;

/// Where a walk has come to: a chart and the motion into it.
struct Stand {
  int chart = 0;
  Transition motion;
};

Stand step_across(const BaseComplex& base, const Stand& from, int edge) {
  const int h = 3 * from.chart + edge;
  return {base.twins[h] / 3, base.across(h) * from.motion};
}

/// A corner of the face that is known to lie at the same place of the same chart, for the walk to start from.
std::optional<Complex> anchor(const Parameterization& map, int face) {
  std::optional<Complex> found;
  for (int k = 0; k < 3; ++k) {
    const int v = map.surface.faces[face][k];
    const Complex corner = map.face_corners[face][k];
    if (map.patch[v] != map.face_chart[face] || std::abs(map.position[v] - corner) > kSamePlace) continue;
    const Weights w = chart_barycentric(corner);
    // A base vertex is the start of last resort: the walk cannot tell there which way round it goes.
    if (std::max({w[0], w[1], w[2]}) < 1.0 - kSamePlace) return corner;
    found = corner;
  }
  return found;
}

/// Walks straight from `start`, a point of the face's chart, to `goal` in the same coordinates, and stops in the base
/// face that holds the goal, or at a boundary.
Stand walk(const BaseComplex& base, int chart, Complex start, Complex goal) {
  Stand stand{chart, {}};
  int entry = -1;
  for (int steps = 0; steps < kMaxPieces; ++steps) {
    const Weights from = chart_barycentric(stand.motion.apply(start)), to = chart_barycentric(stand.motion.apply(goal));
    int exit = -1;
    double soonest = 0.0;
    for (int edge = 0; edge < 3; ++edge) {
      const int across = (edge + 2) % 3;
      if (edge == entry || to[across] >= 0.0) continue;
      const double when = from[across] / (from[across] - to[across]);
      if (exit >= 0 && !(when < soonest)) continue;
      exit = edge;
      soonest = when;
    }
    if (exit < 0 || base.twins[3 * stand.chart + exit] < 0) break;
    entry = base.twins[3 * stand.chart + exit] % 3;
    stand = step_across(base, stand, exit);
  }
  return stand;
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

/// Faces unfolded at a time by one thread.
constexpr std::size_t kBlock = 4096;

bool same(const FacePiece& a, const FacePiece& b) { return a.chart == b.chart && a.motion == b.motion; }

}  // namespace

void develop_triangle(const BaseComplex& base, int face, int chart, Complex start,
                      const std::array<Complex, 3>& corners, std::vector<FacePiece>& pieces) {
  const std::size_t first = pieces.size();
  const Complex centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
  const Stand stand = walk(base, chart, start, centroid);
  pieces.push_back({stand.chart, face, stand.motion});
  for (std::size_t at = first; at < pieces.size(); ++at) {
    const FacePiece here = pieces[at];
    std::array<Weights, 3> weights;
    for (int k = 0; k < 3; ++k) weights[k] = chart_barycentric(here.motion.apply(corners[k]));
    for (int edge = 0; edge < 3; ++edge) {
      if (base.twins[3 * here.chart + edge] < 0 || !crosses(weights, edge)) continue;
      const Stand next = step_across(base, {here.chart, here.motion}, edge);
      const FacePiece there{next.chart, face, next.motion};
      const auto known = [&](const FacePiece& p) { return same(p, there); };
      if (pieces.size() - first >= kMaxPieces || std::any_of(pieces.begin() + first, pieces.end(), known)) continue;
      pieces.push_back(there);
    }
  }
}

void develop_face(const Parameterization& map, int face, std::vector<FacePiece>& pieces) {
  const Complex start = anchor(map, face).value_or(chart_position(1.0 / 3.0, 1.0 / 3.0));
  develop_triangle(map.base, face, map.face_chart[face], start, map.face_corners[face], pieces);
}

std::vector<std::vector<FacePiece>> pieces_by_chart(const Parameterization& map) {
  const std::size_t faces = map.surface.faces.size();
  std::vector<std::vector<FacePiece>> blocks((faces + kBlock - 1) / kBlock);
  parallel_for(faces, kBlock, [&](std::size_t begin, std::size_t end) {
    std::vector<FacePiece>& pieces = blocks[begin / kBlock];
    for (std::size_t f = begin; f < end; ++f) develop_face(map, static_cast<int>(f), pieces);
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
