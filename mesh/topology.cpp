#include "mesh/topology.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Geometry>

#include "mesh/disjoint_sets.h"
#include "mesh/edge_groups.h"
#include "mesh/weld.h"

namespace gsp {

namespace {

/// Areas of faces that are triangles only by rounding: so many units in the last place of the largest coordinate high.
constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();

bool is_finite(const Vec3& p) { return p.allFinite() && p.cwiseAbs().maxCoeff() <= kLargestCoordinate; }

bool in_range(const Triangle& t, const Mesh& mesh) {
  return std::all_of(t.begin(), t.end(), [&](int v) { return v >= 0 && v < mesh.vertex_count(); });
}

Error out_of_range(int face, int vertices) {
  return Error(Cause::IndexOutOfRange, "a face names a vertex that is none of " + std::to_string(vertices),
               Element::Face, face);
}

/// Without squares, which small numbers lose. A single point has nothing to lose.
bool too_small(const Eigen::AlignedBox3d& box) {
  const double extent = box.sizes().maxCoeff();
  return extent > 0.0 && extent < kSmallestExtent;
}

constexpr const char* kNoFace = "there is no face: a point cloud, a wire frame or an empty file";
constexpr const char* kNotFinite = "a coordinate is not a finite number, or too large to compute areas with";
constexpr const char* kTooSmall = "the surface is smaller than 1e-60, too small to compute areas with: scale it";

/// Builds a report in one pass over the edges and one over the fans of corners.
class Analysis {
 public:
  explicit Analysis(const Mesh& mesh)
      : mesh_(mesh), edges_(mesh), faces_(mesh.faces.size()), fans_(3 * mesh.faces.size()) {}

  TopologyReport run() {
    report_.vertices = mesh_.vertex_count();
    report_.faces = mesh_.face_count();
    check_vertices();
    check_faces();
    for (int e = 0; e < edges_.size(); ++e) visit_edge(e);
    std::sort(report_.duplicate_faces.begin(), report_.duplicate_faces.end());
    number_components();
    measure_components();
    count_edges();
    count_fans();
    count_loops();
    for (ComponentReport& c : report_.components) {
      c.orientable = c.orientable && c.manifold;
      if (c.orientable) c.genus = (2 - (c.vertices - c.edges + c.faces) - c.boundary_loops) / 2;
    }
    return std::move(report_);
  }

 private:
  void check_vertices() {
    std::vector<char> used(mesh_.positions.size(), 0);
    for (const Triangle& t : mesh_.faces)
      if (!names_vertex_twice(t))
        for (int v : t) used[v] = 1;
    const std::vector<int> first = first_at_same_position(mesh_.positions);
    for (int v = 0; v < mesh_.vertex_count(); ++v) {
      if (!used[v]) report_.isolated_vertices.push_back(v);
      if (!is_finite(mesh_.positions[v])) report_.non_finite_vertices.push_back(v);
      if (first[v] != v) ++report_.duplicate_positions;
    }
  }

  void check_faces() {
    for (int f = 0; f < mesh_.face_count(); ++f) {
      if (names_vertex_twice(mesh_.faces[f]))
        report_.repeated_index_faces.push_back(f);
      else if (face_area(mesh_, f) == 0.0)
        report_.zero_area_faces.push_back(f);
    }
  }

  std::array<int, 2> ends(int h) const {
    const int a = vertex_at(mesh_, h), b = vertex_at(mesh_, next_corner(h));
    return {std::min(a, b), std::max(a, b)};
  }

  void visit_edge(int e) {
    const std::span<const int> halves = edges_[e];
    const int first = halves[0];
    const auto from = [&](int h) { return vertex_at(mesh_, h); };
    if (halves.size() == 1) boundary_.push_back(first);
    if (halves.size() == 2 && from(halves[0]) == from(halves[1])) report_.misoriented_edges.push_back(ends(first));
    if (halves.size() > 2) {
      report_.non_manifold_edges.push_back(ends(first));
      complex_.push_back(first);
    }
    for (int h : halves.subspan(1)) {
      const bool same_way = from(h) == from(first);
      // Around an edge of more than two faces no choice of sides is consistent, so it binds none.
      if (!faces_.unite(first / 3, h / 3, halves.size() == 2 && same_way) && halves.size() == 2)
        one_sided_.push_back(first / 3);
      fans_.unite(first, same_way ? h : next_corner(h));
      fans_.unite(next_corner(first), same_way ? next_corner(h) : h);
    }
    find_duplicates(halves);
  }

  /// A face's duplicates share all its edges; looking only at the edge opposite its largest vertex finds each once.
  void find_duplicates(std::span<const int> halves) {
    if (halves.size() < 2) return;
    std::vector<std::pair<int, int>> candidates;
    for (int h : halves) {
      const int opposite = vertex_at(mesh_, next_corner(next_corner(h)));
      if (opposite > ends(h)[1]) candidates.emplace_back(opposite, h / 3);
    }
    std::sort(candidates.begin(), candidates.end());
    for (std::size_t i = 1; i < candidates.size(); ++i)
      if (candidates[i].first == candidates[i - 1].first) report_.duplicate_faces.push_back(candidates[i].second);
  }

  ComponentReport& component(int face) { return report_.components[component_[faces_.root(face)]]; }

  void number_components() {
    component_.assign(mesh_.faces.size(), -1);
    for (int f = 0; f < mesh_.face_count(); ++f) {
      if (names_vertex_twice(mesh_.faces[f])) continue;
      if (faces_.root(f) == f) {  // a root is its set's smallest member
        component_[f] = static_cast<int>(report_.components.size());
        report_.components.emplace_back().first_face = f;
      }
      ++component(f).faces;
    }
    for (int f : one_sided_) component(f).orientable = false;
    for (int h : complex_) component(h / 3).manifold = false;
  }

  void measure_components() {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh_.faces)
      if (!names_vertex_twice(t))
        for (int v : t) box.extend(mesh_.positions[v]);
    if (box.isEmpty()) return;
    report_.too_small = report_.non_finite_vertices.empty() && too_small(box);
    const double largest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    for (int f = 0; f < mesh_.face_count(); ++f) {
      if (names_vertex_twice(mesh_.faces[f])) continue;
      double longest = 0.0;
      for (int k = 0; k < 3; ++k) {
        const auto [a, b] = ends(3 * f + k);
        longest = std::max(longest, (mesh_.positions[a] - mesh_.positions[b]).norm());
      }
      if (face_area(mesh_, f) > kRounding * largest * longest) component(f).has_area = true;
    }
  }

  void count_edges() {
    for (int e = 0; e < edges_.size(); ++e) ++component(edges_[e][0] / 3).edges;
  }

  /// A vertex counts once in every component that has a fan around it.
  void count_fans() {
    std::vector<int> first_fan(mesh_.positions.size(), -1);
    std::map<int, std::vector<int>> more_fans;
    for (int f = 0; f < mesh_.face_count(); ++f) {
      if (names_vertex_twice(mesh_.faces[f])) continue;
      for (int corner = 3 * f; corner < 3 * f + 3; ++corner) {
        if (fans_.root(corner) != corner) continue;
        int& first = first_fan[vertex_at(mesh_, corner)];
        if (first < 0) {
          first = corner;
          ++component(f).vertices;
        } else {
          more_fans[vertex_at(mesh_, corner)].push_back(corner);
        }
      }
    }
    for (const auto& [vertex, fans] : more_fans) {
      report_.non_manifold_vertices.push_back(vertex);
      std::map<ComponentReport*, int> here = {{&component(first_fan[vertex] / 3), 1}};
      for (int corner : fans) {
        ComponentReport& c = component(corner / 3);
        if (++here[&c] == 1)
          ++c.vertices;
        else
          c.manifold = false;
      }
    }
  }

  void count_loops() {
    if (boundary_.empty()) return;
    DisjointSets loops(3 * mesh_.faces.size());
    for (int h : boundary_) loops.unite(fans_.root(h), fans_.root(next_corner(h)));
    // Every boundary fan is the start or the end of a boundary half-edge, and a root is the smallest of its loop's
    // fans.
    std::vector<int> roots;
    for (int h : boundary_) roots.push_back(loops.root(fans_.root(h)));
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    for (int root : roots) ++component(root / 3).boundary_loops;
    report_.boundary_loops = static_cast<int>(roots.size());
    report_.boundary_edges = static_cast<int>(boundary_.size());
  }

  const Mesh& mesh_;
  EdgeGroups edges_;
  DisjointSets faces_;          ///< components; signs are the sides
  DisjointSets fans_;           ///< corners, joined where their faces share an edge at the same vertex
  std::vector<int> boundary_;   ///< half-edges without a partner
  std::vector<int> complex_;    ///< a half-edge of each edge with more than two faces
  std::vector<int> one_sided_;  ///< a face of each contradiction between sides
  std::vector<int> component_;  ///< #F, at roots: number of the component
  TopologyReport report_;
};

Place place_of(const std::array<int, 2>& edge) { return {Element::Edge, edge[0], edge[1]}; }

std::optional<Error> refusal_of(const TopologyReport& r) {
  if (r.faces == 0) return Error(Cause::NoFaces, kNoFace);
  if (!r.out_of_range_faces.empty()) return out_of_range(r.out_of_range_faces[0], r.vertices);
  if (!r.non_finite_vertices.empty())
    return Error(Cause::NonFinite, kNotFinite, Element::Vertex, r.non_finite_vertices[0]);
  if (r.too_small) return Error(Cause::TooSmall, kTooSmall);
  if (!r.repeated_index_faces.empty())
    return Error(Cause::DegenerateFace, "a face names the same vertex twice", Element::Face, r.repeated_index_faces[0]);
  if (!r.duplicate_faces.empty())
    return Error(Cause::DuplicateFace, "a face has the same three vertices as an earlier one", Element::Face,
                 r.duplicate_faces[0]);
  if (!r.non_manifold_edges.empty())
    return Error(Cause::NonManifoldEdge, "an edge has more than two faces", place_of(r.non_manifold_edges[0]));
  if (!r.non_manifold_vertices.empty())
    return Error(Cause::NonManifoldVertex, "the faces around a vertex form more than one fan", Element::Vertex,
                 r.non_manifold_vertices[0]);
  for (const ComponentReport& c : r.components)
    if (!c.orientable)
      return Error(Cause::InconsistentOrientation, "the component has one side only, like a Moebius strip",
                   Element::Face, c.first_face);
  if (!r.misoriented_edges.empty())
    return Error(Cause::InconsistentOrientation, "both faces run the same way through an edge",
                 place_of(r.misoriented_edges[0]));
  for (const ComponentReport& c : r.components)
    if (!c.has_area)
      return Error(Cause::NoArea,
                   "a component of " + std::to_string(c.faces) +
                       " faces has no area: the corners of each lie on a line, up to rounding of the coordinates",
                   Element::Face, c.first_face);
  return std::nullopt;
}

}  // namespace

TopologyReport topology_report(const Mesh& mesh) {
  require_countable(mesh.positions.size(), mesh.faces.size());
  std::vector<int> out_of_range_faces;
  for (int f = 0; f < mesh.face_count(); ++f)
    if (!in_range(mesh.faces[f], mesh)) out_of_range_faces.push_back(f);
  TopologyReport report;
  if (out_of_range_faces.empty()) {
    report = Analysis(mesh).run();
  } else {
    Mesh rest = mesh;
    for (int f : out_of_range_faces) rest.faces[f] = {0, 0, 0};  // one that names a vertex twice counts for nothing
    report = Analysis(rest).run();
    std::erase_if(report.repeated_index_faces,
                  [&](int f) { return std::binary_search(out_of_range_faces.begin(), out_of_range_faces.end(), f); });
    report.out_of_range_faces = std::move(out_of_range_faces);
  }
  report.refusal = refusal_of(report);
  return report;
}

void require_parameterizable(const Mesh& mesh) {
  const TopologyReport report = topology_report(mesh);
  if (report.refusal) throw *report.refusal;
}

void require_countable(std::size_t vertices, std::size_t faces) {
  constexpr std::size_t limit = std::numeric_limits<int>::max();
  if (vertices > limit || faces > limit / 3)
    throw Error(Cause::Malformed, "more vertices or faces than can be numbered");
}

void require_computable(const std::vector<Vec3>& positions) {
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!is_finite(positions[v])) throw Error(Cause::NonFinite, kNotFinite, Element::Vertex, static_cast<long long>(v));
    box.extend(positions[v]);
  }
  if (!box.isEmpty() && too_small(box)) throw Error(Cause::TooSmall, kTooSmall);
}

void require_indices(const Mesh& mesh) {
  require_countable(mesh.positions.size(), mesh.faces.size());
  for (int f = 0; f < mesh.face_count(); ++f)
    if (!in_range(mesh.faces[f], mesh)) throw out_of_range(f, mesh.vertex_count());
}

void require_finite_surface(const Mesh& mesh) {
  if (mesh.faces.empty()) throw Error(Cause::NoFaces, kNoFace);
  require_indices(mesh);
  require_computable(mesh.positions);
}

int orient_consistently(Mesh& mesh) {
  require_indices(mesh);
  const EdgeGroups edges(mesh);
  DisjointSets sides(mesh.faces.size());
  for (int e = 0; e < edges.size(); ++e) {
    const std::span<const int> halves = edges[e];
    if (halves.size() != 2) continue;
    const bool same_way = vertex_at(mesh, halves[0]) == vertex_at(mesh, halves[1]);
    if (!sides.unite(halves[0] / 3, halves[1] / 3, same_way))
      throw Error(Cause::InconsistentOrientation, "the component has one side only, like a Moebius strip",
                  Element::Face, halves[0] / 3);
  }
  std::vector<int> surplus(mesh.faces.size(), 0);  // at roots: faces on the root's side minus the others
  for (int f = 0; f < mesh.face_count(); ++f) surplus[sides.root(f)] += sides.odd(f) ? -1 : 1;
  int turned = 0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const bool root_side_stays = surplus[sides.root(f)] >= 0;
    if (sides.odd(f) != root_side_stays) continue;
    std::swap(mesh.faces[f][1], mesh.faces[f][2]);
    ++turned;
  }
  return turned;
}

}  // namespace gsp
