#include "mesh/features/features.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <queue>

#include <Eigen/Geometry>

#include "mesh/disjoint_sets.h"
#include "mesh/edge.h"
#include "mesh/error.h"
#include "mesh/halfedges.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

constexpr std::size_t kFewVertices = 6;  // of a curve, too few to tell whether it is ragged

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Per half-edge the angle between the normals of its two faces; 0 on a boundary, and at a face without area.
std::vector<double> dihedral_angles(const Mesh& mesh, const Halfedges& halfedges) {
  std::vector<Vec3> normal;
  for (const Triangle& t : mesh.faces) {
    const Vec3 &p = mesh.positions[t[0]], &q = mesh.positions[t[1]], &r = mesh.positions[t[2]];
    normal.push_back((q - p).cross(r - p).normalized());  // unit, so that products stay in range at any size
  }
  std::vector<double> angle(halfedges.twin.size(), 0.0);
  for (std::size_t h = 0; h < angle.size(); ++h) {
    if (halfedges.twin[h] < 0) continue;
    const Vec3 &a = normal[h / 3], &b = normal[halfedges.twin[h] / 3];
    angle[h] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return angle;
}

std::array<int, 2> ends(const Halfedges& halfedges, int h) { return ascending(halfedges.from(h), halfedges.to(h)); }

void require_angle(double degrees) {
  if (!(degrees > 0.0 && degrees < 180.0))
    throw Error(Cause::BadOption, "the angle of features must lie between 0 and 180 degrees");
}

/// Whether a path between two vertices is no longer than that. `reached`: -1 for each vertex, before and after.
bool path_within(const std::vector<std::vector<std::pair<int, double>>>& at, std::vector<double>& reached, int from,
                 int to, double longest) {
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  std::vector<int> touched{from};
  reached[from] = 0.0;
  open.push({0.0, from});
  bool found = false;
  while (!open.empty() && !found) {
    const auto [length, v] = open.top();
    open.pop();
    if (length > reached[v]) continue;
    found = v == to;
    for (const auto& [next, step] : at[v]) {
      const double there = length + step;
      if (there > longest || (reached[next] >= 0.0 && reached[next] <= there)) continue;
      reached[next] = there;
      touched.push_back(next);
      open.push({there, next});
    }
  }
  for (int v : touched) reached[v] = -1.0;
  return found;
}

/// Calls visit(h, e) for each half-edge h on the feature edge of number e.
template <class Visit>
void for_each_on(const FeatureEdges& edges, const Halfedges& halfedges, Visit&& visit) {
  for (int h = 0; h < static_cast<int>(halfedges.twin.size()); ++h) {
    const auto found = std::lower_bound(edges.begin(), edges.end(), ends(halfedges, h));
    if (found != edges.end() && *found == ends(halfedges, h)) visit(h, found - edges.begin());
  }
}

/// The dihedral angle at each edge.
std::vector<double> turns_of(const Mesh& mesh, const Halfedges& halfedges, const FeatureEdges& edges) {
  const std::vector<double> angle = dihedral_angles(mesh, halfedges);
  std::vector<double> turn(edges.size(), 0.0);
  for_each_on(edges, halfedges, [&](int h, std::ptrdiff_t e) { turn[e] = angle[h]; });
  return turn;
}

/// Feature edges by their vertices.
class Network {
 public:
  Network(const Mesh& mesh, const FeatureEdges& edges) : mesh_(mesh), edges_(edges), at_(mesh.positions.size()) {
    const Halfedges halfedges(mesh);
    turn_ = turns_of(mesh, halfedges, edges);
    for (std::size_t e = 0; e < edges.size(); ++e)
      for (int v : edges[e]) at_[v].push_back(static_cast<int>(e));
    corner_.assign(at_.size(), 0);
    for (std::size_t v = 0; v < at_.size(); ++v)
      corner_[v] = !at_[v].empty() && (at_[v].size() != 2 || halfedges.boundary_vertex(static_cast<int>(v)));
  }

  std::vector<FeatureCurve> curves() {
    taken_.assign(edges_.size(), 0);
    std::vector<FeatureCurve> result;
    for (const bool closed : {false, true})
      for (std::size_t v = 0; v < at_.size(); ++v)
        for (int e : at_[v])
          if (!taken_[e] && (closed || corner_[v])) result.push_back(walk(static_cast<int>(v), e, closed));
    return result;
  }

 private:
  FeatureCurve walk(int start, int edge, bool closed) {
    FeatureCurve curve{{start}, closed, 0.0, 0.0};
    for (int v = start; edge >= 0;) {
      taken_[edge] = 1;
      const int next = edges_[edge][0] == v ? edges_[edge][1] : edges_[edge][0];
      const double length = (mesh_.positions[next] - mesh_.positions[v]).norm();
      curve.length += length;
      curve.turn += length * turn_[edge];
      curve.vertices.push_back(next);
      v = next;
      if (corner_[v] || v == start) break;
      edge = at_[v][taken_[at_[v][0]] ? 1 : 0];
      if (taken_[edge]) break;
    }
    curve.turn = curve.length > 0.0 ? curve.turn / curve.length : 0.0;
    return curve;
  }

  const Mesh& mesh_;
  const FeatureEdges& edges_;
  std::vector<std::vector<int>> at_;  ///< per vertex its edges
  std::vector<double> turn_;          ///< per edge
  std::vector<char> corner_, taken_;
};

/// Of edges, sharpest first, those that close no short cycle with those before them: where a crease is a band of sharp
/// edges one line of it is left.
FeatureEdges without_short_cycles(const Mesh& mesh, const FeatureEdges& edges, double shortest) {
  const std::vector<double> turn = turns_of(mesh, Halfedges(mesh), edges);
  std::vector<int> order(edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return turn[a] > turn[b]; });
  std::vector<std::vector<std::pair<int, double>>> at(mesh.positions.size());
  std::vector<double> reached(mesh.positions.size(), -1.0);
  FeatureEdges kept;
  for (int e : order) {
    const auto [a, b] = edges[e];
    const double length = (mesh.positions[a] - mesh.positions[b]).norm();
    if (path_within(at, reached, a, b, shortest - length)) continue;
    at[a].emplace_back(b, length);
    at[b].emplace_back(a, length);
    kept.push_back(edges[e]);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

/// Of each edge, how many times sharper it is than the second calmest of the four other sides of its faces.
std::vector<double> clarities_of(const Mesh& mesh, const FeatureEdges& edges) {
  constexpr double kCalm = 1e-3;  // radians, as good as flat
  const Halfedges halfedges(mesh);
  const std::vector<double> angle = dihedral_angles(mesh, halfedges);
  std::vector<double> clarity(edges.size(), 0.0);
  for_each_on(edges, halfedges, [&](int h, std::ptrdiff_t e) {
    const int twin = halfedges.twin[h];
    std::array<double, 4> others{angle[Halfedges::next(h)], angle[Halfedges::prev(h)], angle[Halfedges::next(twin)],
                                 angle[Halfedges::prev(twin)]};
    std::sort(others.begin(), others.end());
    clarity[e] = angle[h] / std::max(others[1], kCalm);
  });
  return clarity;
}

/// How many curves end at each vertex.
std::vector<int> ends_of(const Mesh& mesh, const std::vector<FeatureCurve>& curves) {
  std::vector<int> count(mesh.positions.size(), 0);
  for (const FeatureCurve& c : curves)
    if (!c.closed)
      for (int v : {c.vertices.front(), c.vertices.back()}) ++count[v];
  return count;
}

/// Length of a curve's edges over that of the steps over every two of them; 1 for a straight one.
double raggedness(const Mesh& mesh, const FeatureCurve& curve) {
  double edges = 0.0, steps = 0.0;
  for (std::size_t i = 0; i + 2 < curve.vertices.size(); ++i) {
    const Vec3 &a = mesh.positions[curve.vertices[i]], &b = mesh.positions[curve.vertices[i + 1]],
               &c = mesh.positions[curve.vertices[i + 2]];
    edges += (b - a).norm() + (c - b).norm();
    steps += (c - a).norm();
  }
  return steps > 0.0 ? edges / steps : 1.0;
}

/// Drops curves that are unclear or ragged, but for short ones between clear ones.
FeatureEdges clear_ones(const Mesh& mesh, const FeatureEdges& edges, const FeatureOptions& options, double shortest) {
  const std::vector<double> clarity = clarities_of(mesh, edges);
  std::vector<FeatureCurve> clear, unclear;
  for (FeatureCurve& c : feature_curves(mesh, edges)) {
    std::vector<double> along;
    for (std::size_t i = 0; i + 1 < c.vertices.size(); ++i) {
      const auto edge = ascending(c.vertices[i], c.vertices[i + 1]);
      along.push_back(clarity[std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin()]);
    }
    std::nth_element(along.begin(), along.begin() + along.size() / 2, along.end());
    const bool is_clear = c.turn >= radians(options.strong) && along[along.size() / 2] >= options.clarity &&
                          (c.vertices.size() < kFewVertices || raggedness(mesh, c) < options.ragged);
    (is_clear ? clear : unclear).push_back(std::move(c));
  }
  const std::vector<int> at = ends_of(mesh, clear);
  for (FeatureCurve& c : unclear)
    if (!c.closed && c.length < shortest && at[c.vertices.front()] > 0 && at[c.vertices.back()] > 0)
      clear.push_back(std::move(c));
  return edges_of(clear);
}

/// Drops curves that are short and hang loose, as long as there are any.
std::vector<FeatureCurve> without_short_ones(const Mesh& mesh, FeatureEdges edges, double shortest) {
  const Halfedges halfedges(mesh);
  for (;;) {
    std::vector<FeatureCurve> curves = feature_curves(mesh, edges);
    const std::vector<int> at = ends_of(mesh, curves);
    const auto loose = [&](int v) { return at[v] == 1 && !halfedges.boundary_vertex(v); };
    const auto drop = [&](const FeatureCurve& c) {
      return c.closed ? c.length < 2.0 * shortest
                      : c.length < shortest && (loose(c.vertices.front()) || loose(c.vertices.back()));
    };
    const std::size_t before = curves.size();
    curves.erase(std::remove_if(curves.begin(), curves.end(), drop), curves.end());
    if (curves.size() == before) return curves;
    edges = edges_of(curves);
  }
}

/// Drops connected curves that are short in all.
FeatureEdges without_lonely_ones(const Mesh& mesh, std::vector<FeatureCurve> curves, double lonely) {
  DisjointSets sets(mesh.positions.size());
  for (const FeatureCurve& c : curves) sets.unite(c.vertices.front(), c.vertices.back());
  std::vector<double> length(mesh.positions.size(), 0.0);
  for (const FeatureCurve& c : curves) length[sets.root(c.vertices.front())] += c.length;
  const auto drop = [&](const FeatureCurve& c) { return !c.closed && length[sets.root(c.vertices.front())] < lonely; };
  curves.erase(std::remove_if(curves.begin(), curves.end(), drop), curves.end());
  return edges_of(curves);
}

}  // namespace

std::vector<FeatureCurve> feature_curves(const Mesh& mesh, const FeatureEdges& edges) {
  return Network(mesh, edges).curves();
}

FeatureEdges edges_of(const std::vector<FeatureCurve>& curves) {
  FeatureEdges edges;
  for (const FeatureCurve& c : curves)
    for (std::size_t i = 0; i + 1 < c.vertices.size(); ++i)
      edges.push_back(ascending(c.vertices[i], c.vertices[i + 1]));
  std::sort(edges.begin(), edges.end());
  return edges;
}

FeatureEdges edges_sharper_than(const Mesh& mesh, double degrees) {
  require_angle(degrees);
  require_indices(mesh);
  const Halfedges halfedges(mesh);
  const std::vector<double> angle = dihedral_angles(mesh, halfedges);
  FeatureEdges edges;
  for (int h = 0; h < static_cast<int>(angle.size()); ++h)
    if (halfedges.twin[h] > h && angle[h] >= radians(degrees)) edges.push_back(ends(halfedges, h));
  std::sort(edges.begin(), edges.end());
  return edges;
}

FeatureEdges detect_features(const Mesh& mesh, const FeatureOptions& options) {
  require_angle(options.weak);
  if (!(options.strong >= options.weak))
    throw Error(Cause::BadOption, "the weak angle must not be over the strong one");
  const FeatureEdges strong = edges_sharper_than(mesh, options.strong), weak = edges_sharper_than(mesh, options.weak);
  std::vector<std::vector<int>> at(mesh.positions.size());
  for (std::size_t e = 0; e < weak.size(); ++e)
    for (int v : weak[e]) at[v].push_back(static_cast<int>(e));
  std::vector<char> taken(weak.size(), 0);
  std::vector<int> open;
  const auto take = [&](int e) {
    if (!taken[e]) open.push_back(e);
    taken[e] = 1;
  };
  for (const auto& edge : strong)
    take(static_cast<int>(std::lower_bound(weak.begin(), weak.end(), edge) - weak.begin()));
  while (!open.empty()) {
    const int e = open.back();
    open.pop_back();
    for (int v : weak[e])
      for (int next : at[v]) take(next);
  }
  FeatureEdges edges;
  for (std::size_t e = 0; e < weak.size(); ++e)
    if (taken[e]) edges.push_back(weak[e]);
  const double diagonal = bounding_box_diagonal(mesh), shortest = options.shortest * diagonal;
  edges = edges_of(without_short_ones(mesh, without_short_cycles(mesh, edges, 2.0 * shortest), shortest));
  edges = clear_ones(mesh, edges, options, shortest);
  edges = without_lonely_ones(mesh, without_short_ones(mesh, edges, shortest), options.lonely * diagonal);
  double length = 0.0;
  for (const auto& [a, b] : edges) length += (mesh.positions[a] - mesh.positions[b]).norm();
  return length < options.least * diagonal ? FeatureEdges{} : edges;
}

}  // namespace gsp
