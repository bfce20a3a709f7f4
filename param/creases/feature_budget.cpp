#include "param/creases/feature_budget.h"

#include <algorithm>

#include "mesh/edge.h"
#include "mesh/error.h"
#include "mesh/halfedges.h"

namespace gsp {

namespace {

constexpr int kClosed = 3;        // base vertices of a closed curve
constexpr double kRoom = 0.4;     // of the base vertices asked for,
constexpr double kAutomatic = 8;  // or vertices of the surface for each, where the base's size is automatic

void require_edges(const Mesh& mesh, const FeatureEdges& edges) {
  const Halfedges halfedges(mesh);
  FeatureEdges interior;
  for (int h = 0; h < static_cast<int>(halfedges.twin.size()); ++h)
    if (halfedges.twin[h] > h) interior.push_back(ascending(halfedges.from(h), halfedges.to(h)));
  std::sort(interior.begin(), interior.end());
  for (const auto& edge : edges) {
    if (edge[0] < 0 || edge[1] >= mesh.vertex_count())
      throw Error(Cause::IndexOutOfRange, "a feature names a vertex that does not exist");
    if (!std::binary_search(interior.begin(), interior.end(), edge))
      throw Error(Cause::Malformed, "a feature is no edge inside the surface", Place{Element::Edge, edge[0], edge[1]});
  }
  if (!std::is_sorted(edges.begin(), edges.end())) throw Error(Cause::Malformed, "features are not ascending");
}

}  // namespace

FeatureEdges wanted_features(const Mesh& mesh, const ParameterizeOptions& options) {
  if (options.features) {
    require_edges(mesh, *options.features);
    return *options.features;
  }
  if (options.feature_degrees == kNoFeatures) return {};
  if (options.feature_degrees == kAutoFeatures) return detect_features(mesh);
  return edges_sharper_than(mesh, options.feature_degrees);
}

int base_for_all(const std::vector<FeatureCurve>& curves) {
  const int corners = corners_needed(curves);
  int base = static_cast<int>(corners / kRoom);
  while (corners > kRoom * base) ++base;
  return base;
}

int corners_needed(const std::vector<FeatureCurve>& curves) {
  std::vector<int> corners;
  int needed = 0;
  for (const FeatureCurve& c : curves) {
    if (c.closed)
      needed += kClosed;
    else
      corners.insert(corners.end(), {c.vertices.front(), c.vertices.back()});
  }
  std::sort(corners.begin(), corners.end());
  return needed + static_cast<int>(std::unique(corners.begin(), corners.end()) - corners.begin());
}

ChosenFeatures choose_features(const Mesh& mesh, const ParameterizeOptions& options) {
  ChosenFeatures chosen{wanted_features(mesh, options), 0, 0};
  if (chosen.edges.empty()) return chosen;
  std::vector<FeatureCurve> curves = feature_curves(mesh, chosen.edges);
  const double room = options.base_vertices > 0 ? kRoom * options.base_vertices
                                                : std::max(kAutomatic, mesh.vertex_count() / kAutomatic);
  while (!curves.empty() && corners_needed(curves) > room) {
    std::stable_sort(curves.begin(), curves.end(), [](const FeatureCurve& a, const FeatureCurve& b) {
      return a.length * a.turn > b.length * b.turn;
    });
    const std::size_t drop = std::max<std::size_t>(1, curves.size() / 10);
    chosen.given_way += static_cast<int>(drop);
    curves.resize(curves.size() - drop);
    chosen.edges = edges_of(curves);
    curves = feature_curves(mesh, chosen.edges);
  }
  chosen.curves = static_cast<int>(curves.size());
  return chosen;
}

}  // namespace gsp
