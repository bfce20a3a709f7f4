#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// One level of a semi-regular mesh's connectivity. Vertex and face numbering is fixed by these rules, so that
/// connectivity is a function of the base faces and the level alone:
/// - edges are numbered by first appearance over the faces, corner order (0,1), (1,2), (2,0);
/// - the vertex inserted on edge e of a level with V vertices is V + e on the next;
/// - face f = (a,b,c) with midpoints (ab, bc, ca) becomes faces 4f..4f+3 = (a,ab,ca), (ab,b,bc), (ca,bc,c), (ab,bc,ca).
struct SubdivisionLevel {
  int vertex_count = 0;
  std::vector<Triangle> faces;
  std::vector<std::array<int, 2>> edges;       ///< end vertices, in the direction of the first face that has it
  std::vector<std::array<int, 3>> face_edges;  ///< #F, edge of corners (0,1), (1,2), (2,0)
  std::vector<std::array<int, 2>> edge_faces;  ///< #E, the one or two faces; second is -1 on a boundary

  int edge_count() const { return static_cast<int>(edges.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }

  /// Of an edge, the end that is not `vertex`.
  int other_end(int edge, int vertex) const { return edges[edge][edges[edge][0] == vertex]; }
  /// Of an edge, the face that is not `face`; -1 on a boundary.
  int other_face(int edge, int face) const { return edge_faces[edge][edge_faces[edge][0] == face]; }
  /// Of a face, the corner that is not on its side `edge`.
  int opposite_vertex(int face, int edge) const {
    const std::array<int, 3>& sides = face_edges[face];
    return faces[face][sides[0] == edge ? 2 : sides[1] == edge ? 0 : 1];
  }
  /// Of a face, the side at `vertex` that is not `edge`, which is another side at that vertex.
  int other_side(int face, int edge, int vertex) const {
    for (int k = 0; k < 2; ++k) {
      const int side = face_edges[face][k];
      if (side != edge && (edges[side][0] == vertex || edges[side][1] == vertex)) return side;
    }
    return face_edges[face][2];
  }
};

/// The edges around a vertex of a level.
struct VertexFan {
  int valence = 0;
  int boundary_count = 0;                        ///< edges with one face
  std::array<int, 2> boundary_edges = {-1, -1};  ///< the first two of these

  bool regular() const { return valence == 6 && boundary_count == 0; }
};

/// #V. O(E).
std::vector<VertexFan> vertex_fans(const SubdivisionLevel& level);

/// Deepest level that any part of gsp makes or reads: 4^10 faces for each base face.
inline constexpr int kMaxSubdivisionLevel = 10;

/// The base level. Throws Error: IndexOutOfRange, DegenerateFace, NonManifoldEdge, InconsistentOrientation, each with
/// the face. O(F).
SubdivisionLevel base_level(int base_vertices, const std::vector<Triangle>& base_faces);

/// One quadrisection. O(F), without a search: every finer edge is a half of a coarse edge or lies inside a coarse face.
SubdivisionLevel subdivide(const SubdivisionLevel& coarse);

/// Levels 0 (base) to `level`. Throws the errors of `base_level`, and BadOption where `level` is not in
/// 0..kMaxSubdivisionLevel. O(total faces).
std::vector<SubdivisionLevel> subdivision_levels(int base_vertices, const std::vector<Triangle>& base_faces, int level);

/// The control points of a Loop surface along whose normals the vertices of a mesh lie (displacement.h).
struct ControlMesh {
  std::vector<Vec3> points;  ///< #B, whole multiples of `grid` in each coordinate
  double grid = 0.0;         ///< 4, 5, 6 or 7 times a power of two, so that multiples and their quotients are exact
};

/// A mesh with subdivision connectivity: base faces quadrisected `level` times, positions level by level
/// (base vertices first, then for each level the vertices of its edges in edge order).
struct SemiregularMesh {
  int level = 0;
  int base_vertices = 0;
  std::vector<Triangle> base_faces;
  std::vector<Vec3> positions;
  std::optional<ControlMesh> control = {};  ///< of a displaced mesh

  /// The finest level as a plain mesh.
  Mesh mesh() const;
};

}  // namespace gsp
