#pragma once

#include <cstdint>
#include <vector>

#include "remesh/filters/smooth_surface.h"
#include "remesh/semiregular.h"

namespace gsp {

/// A displaced mesh as numbers beside its control mesh's limit surface (Lee, Moreton, Hoppe 2000, "Displaced
/// subdivision surfaces"): one a vertex, and a second one on boundaries.
struct Displacements {
  std::vector<double> along;   ///< #V, in the normal's direction
  std::vector<double> across;  ///< #V, in the conormal's direction, out of the surface; 0 inside
};

/// What vertices inside make of the moves across a boundary. Streams before version 10 have the former.
enum class AcrossRule : std::uint8_t {
  AtBoundary,  ///< nothing: beyond a boundary that is moved far in, normals lead back to no surface
  Carried,  ///< level by level a new vertex inside moves by the mean of its edge's ends, the base's inside by nothing
};

/// #V, how displacements across boundaries move the vertices of the last level. `levels`: from the base on, of
/// `surface`. By operations that IEEE 754 fixes. O(V).
std::vector<Vec3> moves_across(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                               const std::vector<double>& across, AcrossRule rule = AcrossRule::Carried);

/// Where displacements put the vertices. By operations that IEEE 754 fixes. O(V).
std::vector<Vec3> displaced_points(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                   const Displacements& displacements, AcrossRule rule = AcrossRule::Carried);

/// The inverse, of positions that may be off the normals, by the parts that lie on them.
Displacements displacements_of(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                               const std::vector<Vec3>& positions);

/// Those of a displaced mesh, and what they miss.
struct DisplacedForm {
  Displacements displacements;
  double farthest = 0.0;  ///< largest distance of a vertex from where its displacements put it
};

/// Reads the numbers off a mesh that has a control mesh. Throws Error: Malformed, where that does not fit the base,
/// does not lie on its grid or is more than 2^-30 of its extent away from some vertices; NonFinite; the errors of
/// `base_level`. O(V).
DisplacedForm displaced_form(const SemiregularMesh& mesh);

/// Whether it is 4, 5, 6 or 7 times a power of two, within 2^-500..2^500.
bool is_control_grid(double grid);

}  // namespace gsp
