#include "param/linear/global_system.h"

#include <algorithm>
#include <cassert>

#include "mesh/error.h"
#include "param/linear/sparse_solver.h"

namespace gsp {

namespace {

/// A point of a boundary edge lies in that edge's face; only rounding, beside a corner, can have put it into another
/// face of the corner's fan.
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

/// Calls visit(base half-edge, chain) for every boundary edge of the base, with the surface's vertices along it after
/// its first corner, up to and with its last.
template <class Visit>
void for_each_boundary_edge(const Atlas& atlas, Visit&& visit) {
  const Halfedges& halfedges = atlas.surface->halfedges;
  std::vector<int> chain;
  for (int h = 0; h < static_cast<int>(atlas.base.twins.size()); ++h) {
    if (atlas.base.twins[h] >= 0) continue;
    chain.clear();
    int v = atlas.base.vertices[atlas.base.faces[h / 3][h % 3]];
    do {
      v = halfedges.to(halfedges.outgoing[v]);
      chain.push_back(v);
    } while (atlas.corner[v] < 0);
    visit(h, chain);
  }
}

/// The equations w (z_i - t(z_j)) summed by rows i.
class System {
 public:
  System(int unknowns, bool hermitian) : hermitian_(hermitian), right_(ComplexVector::Zero(unknowns)) {
    entries_.reserve(static_cast<std::size_t>(unknowns) * (hermitian ? 5 : 8));
  }

  /// `column`: of z_j, -1 where it is held at `held`.
  void add(int row, int column, double weight, const Transition& t, Complex held) {
    entries_.emplace_back(row, row, weight);
    if (column < 0) {
      right_[row] += weight * t.apply(held);
      return;
    }
    right_[row] += weight * t.translation.value();
    // The lower triangle is enough of a Hermitian matrix.
    if (!hermitian_ || column <= row) entries_.emplace_back(row, column, -weight * omega_power(t.rotation));
  }

  ComplexVector solve() const {
    ComplexMatrix matrix(right_.size(), right_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return hermitian_ ? solve_hermitian(matrix, right_) : solve_sparse(matrix, right_);
  }

 private:
  const bool hermitian_;
  std::vector<Eigen::Triplet<Complex>> entries_;
  ComplexVector right_;
};

}  // namespace

std::vector<Complex> solve_vertices(const Atlas& atlas, const LinearWeights& weights,
                                    const std::vector<int>& vertices) {
  assert(std::is_sorted(vertices.begin(), vertices.end()));
  assert(std::none_of(vertices.begin(), vertices.end(), [&](int v) { return atlas.corner[v] >= 0; }));
  if (vertices.empty()) return {};
  const auto row = [&](int v) {
    const auto at = std::lower_bound(vertices.begin(), vertices.end(), v);
    return at != vertices.end() && *at == v ? static_cast<int>(at - vertices.begin()) : -1;
  };
  struct Ends {
    int start, end;
  };
  const std::vector<Spring> springs = weights.springs(atlas, faces_around(*atlas.surface, vertices));
  const bool hermitian = weights.symmetric();
  std::vector<Ends> rows;
  std::vector<double> sum(vertices.size(), 0.0);
  for (const Spring& s : springs) {
    rows.push_back({row(s.start), row(s.end)});
    if (rows.back().start >= 0) sum[rows.back().start] += s.at_start;
    if (rows.back().end >= 0) sum[rows.back().end] += s.at_end;
  }
  System system(static_cast<int>(vertices.size()), hermitian);
  for (std::size_t i = 0; i < springs.size(); ++i) {
    const Spring& s = springs[i];
    const auto [start, end] = rows[i];
    // Rows that sum to 1 condition the system better, but would make it no longer Hermitian.
    if (start >= 0)
      system.add(start, end, hermitian ? s.at_start : s.at_start / sum[start], s.to_start, atlas.position[s.end]);
    if (end >= 0)
      system.add(end, start, hermitian ? s.at_end : s.at_end / sum[end], s.to_start.inverse(), atlas.position[s.start]);
  }
  const ComplexVector solution = system.solve();
  return {solution.data(), solution.data() + solution.size()};
}

std::vector<Complex> solve_global(const Atlas& atlas, const LinearWeights& weights, const std::vector<char>& solved) {
  std::vector<int> vertices;
  for (int v = 0; v < atlas.surface->mesh.vertex_count(); ++v)
    if (solved[v]) vertices.push_back(v);
  const std::vector<Complex> solution = solve_vertices(atlas, weights, vertices);
  std::vector<Complex> position = atlas.position;
  for (std::size_t i = 0; i < vertices.size(); ++i) position[vertices[i]] = solution[i];
  return position;
}

std::vector<char> interior_vertices(const Atlas& atlas) {
  std::vector<char> interior(atlas.patch.size());
  for (std::size_t v = 0; v < interior.size(); ++v) interior[v] = atlas.is_free(static_cast<int>(v));
  return interior;
}

void seat_boundary(Atlas& atlas) {
  for_each_boundary_edge(atlas, [&](int h, const std::vector<int>& chain) {
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) move_to_boundary_chart(atlas, chain[i], h);
  });
}

std::vector<Complex> boundary_by_arc_length(const Atlas& atlas) {
  std::vector<Complex> position = atlas.position;
  const auto& points = atlas.surface->mesh.positions;
  for_each_boundary_edge(atlas, [&](int h, const std::vector<int>& chain) {
    const Complex from = kChartCorners[h % 3].value(), to = kChartCorners[(h % 3 + 1) % 3].value();
    std::vector<double> length;
    int before = atlas.base.vertices[atlas.base.faces[h / 3][h % 3]];
    for (int v : chain) {
      length.push_back((length.empty() ? 0.0 : length.back()) + (points[v] - points[before]).norm());
      before = v;
    }
    const double total = length.back();
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      // Equal spacing where the chain has no length keeps the order strict.
      const double even = double(i + 1) / double(chain.size());
      const double s = total > 0.0 ? (1.0 - 1e-6) * length[i] / total + 1e-6 * even : even;
      position[chain[i]] = from + s * (to - from);
    }
  });
  return position;
}

}  // namespace gsp
