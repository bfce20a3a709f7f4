#include "param/global_system.h"

#include <algorithm>

#include "mesh/error.h"
#include "param/sparse_solver.h"

namespace gsp {

namespace {

/// A point of a boundary edge lies in that edge's face; only rounding, beside a corner, can have put it into another face of
/// the corner's fan.
void move_to_boundary_chart(Atlas& atlas, int vertex, int base_halfedge) {
  const int chart = base_halfedge / 3;
  if (atlas.patch[vertex] == chart) return;
  for (int end = 0; end < 2; ++end) {
    const BaseFan& fan = atlas.fans[atlas.base.faces[chart][(base_halfedge % 3 + end) % 3]];
    const int from = fan.find(atlas.patch[vertex]), to = fan.find(chart);
    if (from < 0) continue;
    atlas.change_chart(vertex, chart, fan.develop(to).inverse() * fan.develop(from));
    return;
  }
  throw Error(Cause::Internal, "a boundary vertex left its boundary edge", Element::Vertex, vertex);
}

double corner_distance(Complex z) {
  return std::min({std::abs(z - kChartCorners[0].value()), std::abs(z - kChartCorners[1].value()),
                   std::abs(z - kChartCorners[2].value())});
}

}  // namespace

int solve_global(Atlas& atlas, const std::vector<std::array<double, 2>>& weights, double held_radius) {
  const Surface& surface = *atlas.surface;
  const int count = surface.mesh.vertex_count();
  std::vector<int> row(count, -1);
  int unknowns = 0;
  for (int v = 0; v < count; ++v)
    if (atlas.patch[v] >= 0 && atlas.corner[v] < 0 && !surface.halfedges.boundary_vertex(v) &&
        corner_distance(atlas.position[v]) >= held_radius)
      row[v] = unknowns++;

  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(unknowns * 7);
  ComplexVector right = ComplexVector::Zero(unknowns);
  for (int v = 0; v < count; ++v) {
    if (row[v] < 0) continue;
    double sum = 0.0;
    surface.for_each_neighbour(v, [&](int, int edge, bool forward) { sum += weights[edge][forward ? 0 : 1]; });
    surface.for_each_neighbour(v, [&](int other, int edge, bool forward) {
      const double c = weights[edge][forward ? 0 : 1] / sum;
      const Transition t = atlas.towards(edge, forward);
      if (row[other] < 0) {
        right[row[v]] += c * t.apply(atlas.position[other]);
      } else {
        entries.emplace_back(row[v], row[other], -c * omega_power(t.rotation));
        right[row[v]] += c * t.translation.value();
      }
    });
    entries.emplace_back(row[v], row[v], 1.0);
  }
  ComplexMatrix matrix(unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const ComplexVector solution = solve_sparse(matrix, right);
  for (int v = 0; v < count; ++v)
    if (row[v] >= 0) atlas.position[v] = solution[row[v]];
  int outside = 0;
  for (int v = 0; v < count; ++v)
    if (row[v] >= 0) outside += !atlas.reassign(v);
  return outside;
}

void place_boundary(Atlas& atlas) {
  const Surface& surface = *atlas.surface;
  const auto& positions = surface.mesh.positions;
  for (int h = 0; h < static_cast<int>(atlas.base.twins.size()); ++h) {
    if (atlas.base.twins[h] >= 0) continue;
    const int chart = h / 3;
    const Complex from = kChartCorners[h % 3].value(), to = kChartCorners[(h % 3 + 1) % 3].value();
    // The chain of surface vertices from this corner to the next one along the boundary.
    std::vector<int> chain;
    std::vector<double> length{0.0};
    int v = atlas.base.vertices[atlas.base.faces[chart][h % 3]];
    do {
      const int out = surface.halfedges.outgoing[v];
      const int next = surface.halfedges.to(out);
      length.push_back(length.back() + (positions[next] - positions[v]).norm());
      chain.push_back(next);
      v = next;
    } while (atlas.corner[v] < 0);
    const double total = length.back();
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const int w = chain[i];
      // Equal spacing where the chain has no length keeps the order strict.
      const double even = double(i + 1) / double(chain.size());
      const double s = total > 0.0 ? (1.0 - 1e-6) * length[i + 1] / total + 1e-6 * even : even;
      const Complex target = from + s * (to - from);
      move_to_boundary_chart(atlas, w, h);
      atlas.position[w] = target;
    }
  }
}

}  // namespace gsp
