#include "tests/support/exact_maps.h"

#include <map>
#include <optional>
#include <utility>

#include "mesh/halfedges.h"
#include "mesh/random.h"

namespace gsp::exact_maps {

namespace {

/// Lattice coordinates of a face's corners in the chart of its base face, in units of the current level's spacing.
using Corners = std::array<Eisenstein, 3>;

struct Pieces {
  Mesh mesh;
  std::vector<int> chart;
  std::vector<Corners> corners;
};

Pieces split(const Pieces& coarse) {
  Pieces fine;
  fine.mesh.positions = coarse.mesh.positions;
  std::map<std::pair<int, int>, int> middle_of;
  const auto middle = [&](int a, int b) {
    const auto [at, inserted] = middle_of.try_emplace({std::min(a, b), std::max(a, b)}, fine.mesh.vertex_count());
    if (inserted) fine.mesh.positions.push_back(0.5 * (coarse.mesh.positions[a] + coarse.mesh.positions[b]));
    return at->second;
  };
  for (std::size_t f = 0; f < coarse.mesh.faces.size(); ++f) {
    const auto [a, b, c] = coarse.mesh.faces[f];
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    const auto [x, y, z] = coarse.corners[f];
    const Corners whole = {x + x, y + y, z + z}, halves = {x + y, y + z, z + x};
    const Triangle faces[4] = {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}};
    const Corners corners[4] = {{whole[0], halves[0], halves[2]},
                                {halves[0], whole[1], halves[1]},
                                {halves[2], halves[1], whole[2]},
                                {halves[0], halves[1], halves[2]}};
    for (int k = 0; k < 4; ++k) {
      fine.mesh.faces.push_back(faces[k]);
      fine.chart.push_back(coarse.chart[f]);
      fine.corners.push_back(corners[k]);
    }
  }
  return fine;
}

/// Moves a position that lies beyond an edge of its patch into the neighbour, where there is one.
void settle(Parameterization& map, int v) {
  for (int k = 0; k < 3; ++k) {
    const int h = 3 * map.patch[v] + k;
    if (chart_barycentric(map.position[v])[(k + 2) % 3] >= 0.0 || map.base.twins[h] < 0) continue;
    map.position[v] = map.base.across(h).apply(map.position[v]);
    map.patch[v] = map.base.twins[h] / 3;
    return;
  }
}

}  // namespace

Parameterization quadrisected(const Mesh& base, int level) {
  Pieces pieces{base, {}, {}};
  for (int f = 0; f < base.face_count(); ++f) {
    pieces.chart.push_back(f);
    pieces.corners.push_back({kChartCorners[0], kChartCorners[1], kChartCorners[2]});
  }
  for (int l = 0; l < level; ++l) pieces = split(pieces);

  Parameterization map;
  map.surface = pieces.mesh;
  for (int v = 0; v < base.vertex_count(); ++v) map.base.vertices.push_back(v);
  map.base.faces = base.faces;
  map.base.connect();
  map.patch.assign(map.surface.positions.size(), -1);
  map.position.resize(map.surface.positions.size());
  map.face_chart = pieces.chart;
  const double spacing = 1.0 / (1 << level);
  for (std::size_t f = 0; f < pieces.corners.size(); ++f) {
    std::array<Complex, 3> corners;
    for (int k = 0; k < 3; ++k) {
      corners[k] = spacing * pieces.corners[f][k].value();
      map.patch[map.surface.faces[f][k]] = pieces.chart[f];
      map.position[map.surface.faces[f][k]] = corners[k];
    }
    map.face_corners.push_back(corners);
  }
  map.provenance = {"method exact", "level " + std::to_string(level)};
  return map;
}

namespace {

/// Of a vertex on a base edge, the side of its patch that this is.
std::optional<int> base_side(const Parameterization& map, int v) {
  for (int e = 0; e < 3; ++e)
    if (std::abs(chart_barycentric(map.position[v])[(e + 2) % 3]) < 1e-12) return e;
  return std::nullopt;
}

void shift_vertices(Parameterization& map, double amount, int level, std::uint64_t seed, bool along_edges) {
  const Halfedges halfedges(map.surface);
  std::vector<char> fixed(map.surface.positions.size(), 0);
  for (int v : map.base.vertices) fixed[v] = 1;
  Random random(seed);
  const double reach = amount / (1 << level);
  std::vector<Complex> shift(map.surface.positions.size());
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    const double x = 2.0 * random.uniform() - 1.0, y = 2.0 * random.uniform() - 1.0;
    if (!fixed[v] && map.patch[v] >= 0 && !halfedges.boundary_vertex(v)) shift[v] = reach * Complex(x, y);
    if (const auto side = base_side(map, v); along_edges && side && !fixed[v])
      shift[v] = reach * x * (kChartCorners[(*side + 1) % 3].value() - kChartCorners[*side].value());
  }
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int v = map.surface.faces[f][k];
      int rotation = 0;
      // A vertex of two charts lies on their common edge, beyond which the shift turns with the chart.
      if (map.patch[v] != map.face_chart[f])
        for (int e = 0; e < 3; ++e) {
          const int h = 3 * map.patch[v] + e;
          const bool on_edge = std::abs(chart_barycentric(map.position[v])[(e + 2) % 3]) < 1e-12;
          if (on_edge && map.base.twins[h] >= 0 && map.base.twins[h] / 3 == map.face_chart[f])
            rotation = map.base.across(h).rotation;
        }
      map.face_corners[f][k] += omega_power(rotation) * shift[v];
    }
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    map.position[v] += shift[v];
    if (shift[v] != Complex()) settle(map, v);
  }
}

}  // namespace

void jitter(Parameterization& map, double amount, int level, std::uint64_t seed) {
  shift_vertices(map, amount, level, seed, false);
}

void jitter_along_edges(Parameterization& map, double amount, int level, std::uint64_t seed) {
  shift_vertices(map, amount, level, seed, true);
}

void rechart(Parameterization& map, std::uint64_t seed) {
  Random random(seed);
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const int h = 3 * map.face_chart[f] + static_cast<int>(random.next() % 3);
    if (random.next() % 2 == 0 || map.base.twins[h] < 0) continue;
    const Transition across = map.base.across(h);
    for (Complex& corner : map.face_corners[f]) corner = across.apply(corner);
    map.face_chart[f] = map.base.twins[h] / 3;
  }
}

void flatten_onto_base(Parameterization& map, const Mesh& base) {
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    if (map.patch[v] < 0) continue;
    const std::array<double, 3> weights = chart_barycentric(map.position[v]);
    map.surface.positions[v].setZero();
    for (int k = 0; k < 3; ++k) map.surface.positions[v] += weights[k] * base.positions[base.faces[map.patch[v]][k]];
  }
}

}  // namespace gsp::exact_maps
