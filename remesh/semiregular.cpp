#include "remesh/semiregular.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "mesh/edge.h"
#include "mesh/error.h"

namespace gsp {

namespace {

void require_level(int level) {
  if (level < 0 || level > kMaxSubdivisionLevel)
    throw Error(Cause::BadOption,
                "subdivision level " + std::to_string(level) + " is not in 0.." + std::to_string(kMaxSubdivisionLevel));
}

void check_face(int base_vertices, const Triangle& t, int face) {
  for (int vertex : t)
    if (vertex < 0 || vertex >= base_vertices)
      throw Error(Cause::IndexOutOfRange, "a base face names vertex " + std::to_string(vertex), Element::Face, face);
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
    throw Error(Cause::DegenerateFace, "a base face names a vertex twice", Element::Face, face);
}

/// Enters side k of a face as edge `edge`, which is new where it equals the number of edges so far.
void add_side(SubdivisionLevel& level, int face, int k, int edge) {
  const int from = level.faces[face][k], to = level.faces[face][(k + 1) % 3];
  if (edge == level.edge_count()) {
    level.edges.push_back({from, to});
    level.edge_faces.push_back({face, -1});
    level.creased.push_back(0);
  } else {
    level.edge_faces[edge][1] = face;
  }
  level.face_edges[face][k] = edge;
}

/// `known`: edges by their key.
void mark_creases(SubdivisionLevel& level, const std::unordered_map<std::uint64_t, int>& known,
                  const Creases& creases) {
  for (std::size_t i = 0; i < creases.size(); ++i) {
    const auto [a, b] = creases[i];
    const auto refuse = [a = a, b = b](const std::string& why) {
      throw Error(Cause::Malformed, "a crease " + why, Place{Element::Edge, a, b});
    };
    if (a >= b || (i > 0 && !(creases[i - 1] < creases[i]))) refuse("is not in ascending order");
    const auto edge = known.find(edge_key(a, b));
    if (edge == known.end()) refuse("is no edge of the base");
    if (level.on_boundary(edge->second)) refuse("is an edge of the boundary");
    level.creased[edge->second] = 1;
  }
}

void mark_corners(SubdivisionLevel& level, const std::vector<int>& corners) {
  if (corners.empty()) return;
  const std::vector<VertexFan> fans = vertex_fans(level);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int v = corners[i];
    const bool known = v >= 0 && v < level.vertex_count && (i == 0 || corners[i - 1] < v);
    if (!known || fans[v].sharp_count != 2 || fans[v].crease_count != 2)
      throw Error(Cause::Malformed, "a corner of a crease is no vertex of two creases, or not in ascending order",
                  Element::Vertex, v);
  }
  level.corners = corners;
}

}  // namespace

int first_level_with(int base_faces, double faces) {
  int level = 0;
  while (level < kMaxSubdivisionLevel && std::ldexp(base_faces, 2 * level) < faces) ++level;
  return level;
}

int last_level_with(std::int64_t base_faces, std::int64_t faces, int most) {
  int level = 0;
  while (level < most && base_faces << (2 * (level + 1)) <= faces) ++level;
  return level;
}

SubdivisionLevel base_level(int base_vertices, const std::vector<Triangle>& base_faces, const Creases& creases,
                            const std::vector<int>& corners) {
  SubdivisionLevel level;
  level.vertex_count = base_vertices;
  level.faces = base_faces;
  level.face_edges.resize(base_faces.size());
  std::unordered_map<std::uint64_t, int> known;
  known.reserve(2 * base_faces.size());
  for (int f = 0; f < level.face_count(); ++f) {
    const Triangle& t = base_faces[f];
    check_face(base_vertices, t, f);
    for (int k = 0; k < 3; ++k) {
      const int from = t[k], to = t[(k + 1) % 3];
      const int edge = known.try_emplace(edge_key(from, to), level.edge_count()).first->second;
      if (edge < level.edge_count()) {
        if (level.edge_faces[edge][1] >= 0)
          throw Error(Cause::NonManifoldEdge, "a base edge has more than two faces", Element::Face, f);
        if (level.edges[edge][0] == from)
          throw Error(Cause::InconsistentOrientation, "two base faces run through an edge the same way", Element::Face,
                      f);
      }
      add_side(level, f, k, edge);
    }
  }
  mark_creases(level, known, creases);
  mark_corners(level, corners);
  return level;
}

std::vector<VertexFan> vertex_fans(const SubdivisionLevel& level) {
  std::vector<VertexFan> fans(level.vertex_count);
  for (int e = 0; e < level.edge_count(); ++e)
    for (int v : level.edges[e]) {
      VertexFan& fan = fans[v];
      ++fan.valence;
      if (!level.sharp(e)) continue;
      if (fan.sharp_count < 2) fan.sharp_edges[fan.sharp_count] = e;
      ++fan.sharp_count;
      fan.crease_count += level.creased[e];
    }
  for (int v : level.corners) fans[v].bent = true;
  return fans;
}

SubdivisionLevel subdivide(const SubdivisionLevel& coarse) {
  SubdivisionLevel fine;
  const int vertices = coarse.vertex_count, edges = coarse.edge_count(), faces = coarse.face_count();
  fine.vertex_count = vertices + edges;
  fine.faces.reserve(4 * static_cast<std::size_t>(faces));
  fine.face_edges.resize(4 * static_cast<std::size_t>(faces));
  const std::size_t fine_edges = 2 * static_cast<std::size_t>(edges) + 3 * static_cast<std::size_t>(faces);
  fine.edges.reserve(fine_edges);
  fine.edge_faces.reserve(fine_edges);

  // Number of the finer edge by what it is: half 2e + (which end of e), or 2E + 3f + (corner it cuts off).
  std::vector<int> number(fine_edges, -1);
  const auto side = [&](int face, int k, int identity) {
    if (number[identity] < 0) number[identity] = fine.edge_count();
    add_side(fine, face, k, number[identity]);
  };
  for (int f = 0; f < faces; ++f) {
    const Triangle& t = coarse.faces[f];
    const std::array<int, 3>& e = coarse.face_edges[f];
    const Triangle mid = {vertices + e[0], vertices + e[1], vertices + e[2]};
    fine.faces.push_back({t[0], mid[0], mid[2]});
    fine.faces.push_back({mid[0], t[1], mid[1]});
    fine.faces.push_back({mid[2], mid[1], t[2]});
    fine.faces.push_back({mid[0], mid[1], mid[2]});
    const auto half = [&](int edge, int end) { return 2 * edge + (coarse.edges[edge][0] == end ? 0 : 1); };
    const auto inner = [&](int corner) { return 2 * edges + 3 * f + corner; };
    side(4 * f, 0, half(e[0], t[0]));
    side(4 * f, 1, inner(0));
    side(4 * f, 2, half(e[2], t[0]));
    side(4 * f + 1, 0, half(e[0], t[1]));
    side(4 * f + 1, 1, half(e[1], t[1]));
    side(4 * f + 1, 2, inner(1));
    side(4 * f + 2, 0, inner(2));
    side(4 * f + 2, 1, half(e[1], t[2]));
    side(4 * f + 2, 2, half(e[2], t[2]));
    side(4 * f + 3, 0, inner(1));
    side(4 * f + 3, 1, inner(2));
    side(4 * f + 3, 2, inner(0));
  }
  fine.corners = coarse.corners;
  for (int half = 0; half < 2 * edges; ++half) fine.creased[number[half]] = coarse.creased[half / 2];
  return fine;
}

std::vector<SubdivisionLevel> subdivision_levels(int base_vertices, const std::vector<Triangle>& base_faces, int level,
                                                 const Creases& creases, const std::vector<int>& corners) {
  require_level(level);
  std::vector<SubdivisionLevel> levels;
  levels.reserve(level + 1);
  levels.push_back(base_level(base_vertices, base_faces, creases, corners));
  for (int l = 0; l < level; ++l) levels.push_back(subdivide(levels.back()));
  return levels;
}

void require_well_formed(const SemiregularMesh& mesh) {
  require_level(mesh.level);
  if (mesh.base_vertices < 0) throw Error(Cause::Malformed, "a mesh has a negative number of base vertices");
  const SubdivisionLevel base = base_level(mesh.base_vertices, mesh.base_faces, mesh.creases, mesh.corners);
  std::size_t vertices = base.vertex_count, edges = base.edges.size(), faces = base.faces.size();
  for (int l = 0; l < mesh.level; ++l) {
    vertices += edges;
    edges = 2 * edges + 3 * faces;
    faces *= 4;
  }
  if (mesh.positions.size() != vertices)
    throw Error(Cause::Malformed, "a semi-regular mesh of " + std::to_string(vertices) + " vertices has " +
                                      std::to_string(mesh.positions.size()) + " positions");
  if (mesh.control && mesh.control->points.size() != static_cast<std::size_t>(mesh.base_vertices))
    throw Error(Cause::Malformed, "a displaced mesh has not as many control points as base vertices");
}

Mesh SemiregularMesh::mesh() const {
  require_well_formed(*this);
  SubdivisionLevel finest = base_level(base_vertices, base_faces);
  for (int l = 0; l < level; ++l) finest = subdivide(finest);
  return {positions, std::move(finest.faces)};
}

std::vector<SubdivisionLevel> SemiregularMesh::levels() const {
  return subdivision_levels(base_vertices, base_faces, level, creases, corners);
}

}  // namespace gsp
