#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/error.h"
#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// One connected component (by edges) of the faces.
struct ComponentReport {
  int vertices = 0;
  int edges = 0;
  int faces = 0;
  int boundary_loops = 0;
  bool manifold = true;    ///< every edge has at most two faces, every vertex one fan of this component's faces
  bool orientable = true;  ///< some choice of sides is consistent, even if the file's is not; false where not manifold
  /// (2 - Euler characteristic - boundary loops) / 2; empty where the component is not an orientable manifold.
  std::optional<int> genus;
  int first_face = 0;
  bool has_area = false;  ///< some face is more than rounding of the coordinates
};

/// What a surface is and why it cannot be used. All indices are those of the mesh, all lists are ascending.
/// Faces that name a vertex twice or one that does not exist count for nothing but their own list. Loops of
/// non-manifold components are a guess.
struct TopologyReport {
  int vertices = 0;
  int faces = 0;
  std::vector<ComponentReport> components;
  int boundary_loops = 0;
  int boundary_edges = 0;  ///< edges of one face
  std::vector<int> isolated_vertices;
  std::vector<int> non_finite_vertices;
  std::vector<std::array<int, 2>> non_manifold_edges;  ///< vertex pairs of more than two faces
  std::vector<int> non_manifold_vertices;              ///< faces around it form more than one fan
  std::vector<std::array<int, 2>> misoriented_edges;   ///< both faces run through it the same way
  std::vector<int> out_of_range_faces;                 ///< a face that names a vertex that does not exist
  std::vector<int> repeated_index_faces;               ///< a face that names a vertex twice
  std::vector<int> duplicate_faces;                    ///< all but the first face on the same three vertices
  std::vector<int> zero_area_faces;                    ///< collinear or coincident corners; usable
  int duplicate_positions = 0;                         ///< vertices at the exact position of an earlier one
  bool too_small = false;                              ///< its box has sides, but none of kSmallestExtent

  /// True where parameterize accepts it.
  bool usable() const { return !refusal.has_value(); }
  /// The first reason why not, most basic first.
  std::optional<Error> refusal;
};

/// Coordinates up to this have squared areas that are finite, their fourth powers.
inline constexpr double kLargestCoordinate = 1e75;
/// Of the longest side of a surface's bounding box. The squared area of a face as small as rounding of such a
/// coordinate is still a number with all its bits.
inline constexpr double kSmallestExtent = 1e-60;

/// For a surface of any indices and coordinates, as long as vertices and half-edges can be numbered. O(V + F log F).
/// Throws Error: Malformed where they cannot.
TopologyReport topology_report(const Mesh& mesh);

/// Throws the report's refusal, if any.
void require_parameterizable(const Mesh& mesh);

/// Throws IndexOutOfRange with the first face that names a vertex that does not exist, Malformed for more than can be
/// numbered. O(F). Functions that take a caller's mesh begin with it, or with a check that includes it.
void require_indices(const Mesh& mesh);

/// The least that measuring and drawing need. Throws NoFaces for a mesh without faces, IndexOutOfRange for a face that
/// names a vertex that does not exist, and what `require_computable` throws. O(V + F).
void require_finite_surface(const Mesh& mesh);

/// Throws NonFinite for a coordinate that is not finite or over kLargestCoordinate, TooSmall where all lie within less
/// than kSmallestExtent but not at one place. O(V).
void require_computable(const std::vector<Vec3>& positions);

/// Refuses to count past what an `int` can number (half-edges included). Throws Error: Malformed.
void require_countable(std::size_t vertices, std::size_t faces);

/// Turns faces so that neighbours agree, in each component the fewer (the ones that disagree with the first face, if as
/// many). Returns how many were turned. Edges of more than two faces bind nothing.
/// Throws InconsistentOrientation with a face of a one-sided component, IndexOutOfRange. O(V + F log F).
int orient_consistently(Mesh& mesh);

}  // namespace gsp
