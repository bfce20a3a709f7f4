#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// Base edges across which a surface is not smooth: pairs a < b of base vertices, in ascending order.
using Creases = std::vector<std::array<int, 2>>;

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
  std::vector<char> creased;                   ///< #E, whether the edge is a crease or a part of one
  std::vector<int> corners;                    ///< base vertices at which a crease bends, ascending

  int edge_count() const { return static_cast<int>(edges.size()); }
  int face_count() const { return static_cast<int>(faces.size()); }

  bool on_boundary(int edge) const { return edge_faces[edge][1] < 0; }
  /// Whether the surface is not smooth across an edge, which is then the end of it for both sides.
  bool sharp(int edge) const { return on_boundary(edge) || creased[edge] != 0; }

  /// Of an edge, the end that is not `vertex`.
  int other_end(int edge, int vertex) const { return edges[edge][edges[edge][0] == vertex]; }
  /// Of an edge, the face that is not `face`; -1 on a boundary.
  int other_face(int edge, int face) const { return edge_faces[edge][edge_faces[edge][0] == face]; }
  /// The same, -1 at any sharp edge: the face into which the surface goes on smoothly.
  int smooth_face(int edge, int face) const { return sharp(edge) ? -1 : other_face(edge, face); }
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
  int sharp_count = 0;                        ///< edges of the boundary and creases
  int crease_count = 0;                       ///< those of them that are creases
  bool bent = false;                          ///< two creases meet at an angle here
  std::array<int, 2> sharp_edges = {-1, -1};  ///< the first two sharp ones

  bool regular() const { return valence == 6 && sharp_count == 0; }
  /// In the surface, not on a curve: no sharp edge ends here, or a single crease (a dart; Hoppe et al. 1994, "Piecewise
  /// smooth surface reconstruction").
  bool inside() const { return sharp_count < 2; }
  /// On a boundary or crease that passes through smoothly. Other vertices of more than one sharp edge are corners.
  bool on_curve() const { return sharp_count == 2 && !bent; }
  /// On a crease or its corner, which no detail of the surface beside it moves.
  bool on_crease() const { return crease_count > 0 && sharp_count > 1; }
  /// The sharp edge that continues the sharp edge `e` beyond this vertex; -1 where a crease ends. (Boundaries that meet
  /// in a vertex are told apart by no rule: streams of versions before creases hold them so.)
  int beyond(int e) const { return crease_count > 0 && !on_curve() ? -1 : sharp_edges[sharp_edges[0] == e]; }
};

/// #V. O(E).
std::vector<VertexFan> vertex_fans(const SubdivisionLevel& level);

/// Deepest level that any part of gsp makes or reads: 4^10 faces for each base face.
inline constexpr int kMaxSubdivisionLevel = 10;

/// The first subdivision level of so many base faces that has at least as many faces as wanted, or the deepest one.
int first_level_with(int base_faces, double faces);

/// The last subdivision level, at most `most`, of so many base faces with no more faces than wanted; 0 where the base
/// itself has more.
int last_level_with(std::int64_t base_faces, std::int64_t faces, int most);

/// The base level. Throws Error: IndexOutOfRange, DegenerateFace, NonManifoldEdge, InconsistentOrientation, each with
/// the face; Malformed where `creases` are not ascending pairs of edges inside, with the edge, or `corners` not
/// ascending vertices of two creases and no other sharp edge, with the vertex. O(F).
SubdivisionLevel base_level(int base_vertices, const std::vector<Triangle>& base_faces, const Creases& creases = {},
                            const std::vector<int>& corners = {});

/// One quadrisection. O(F), without a search: every finer edge is a half of a coarse edge, and a crease if that is, or
/// lies inside a coarse face.
SubdivisionLevel subdivide(const SubdivisionLevel& coarse);

/// Levels 0 (base) to `level`. Throws the errors of `base_level`, and BadOption where `level` is not in
/// 0..kMaxSubdivisionLevel. O(total faces).
std::vector<SubdivisionLevel> subdivision_levels(int base_vertices, const std::vector<Triangle>& base_faces, int level,
                                                 const Creases& creases = {}, const std::vector<int>& corners = {});

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
  Creases creases = {};
  std::vector<int> corners = {};  ///< base vertices at which a crease bends, ascending (crease_corners.h)

  /// The finest level as a plain mesh. Throws what `require_well_formed` throws.
  Mesh mesh() const;
  /// Levels 0 to `level`, with the creases. Throws what `subdivision_levels` throws.
  std::vector<SubdivisionLevel> levels() const;
};

/// Throws where the arrays do not fit together: the errors of `subdivision_levels`, and Malformed where the finest
/// level has not as many vertices as there are positions, or the base not as many as control points. O(base faces).
void require_well_formed(const SemiregularMesh& mesh);

}  // namespace gsp
