#pragma once

#include <array>
#include <vector>

#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// Feature edges of a surface: sharp ones, of two faces each, as pairs of vertices a < b, ascending.
using FeatureEdges = std::vector<std::array<int, 2>>;

/// Feature edges between two corners of the curves they form: vertices where one, or more than two, of them meet, or
/// that lie on the surface's boundary. A curve without corners is closed.
struct FeatureCurve {
  std::vector<int> vertices;  ///< along the curve, both ends; a closed one comes back to its first
  bool closed = false;        ///< it has no corner
  double length = 0.0;        ///< in the surface's units
  double turn = 0.0;          ///< mean dihedral angle along it, radians
};

/// Lengths are shares of the diagonal of the surface's bounding box, >= 0. What surfaces have of each measure:
/// bench/README.md, "Feature curves: what auto takes".
struct FeatureOptions {
  double strong = 40.0;  ///< degrees in (0, 180), dihedral angle from which an edge starts a feature
  double weak = 30.0;    ///< degrees in (0, strong], from which it continues one at its end
  /// Curves shorter than this with an end that hangs loose are dropped, and closed ones shorter than twice this: noise
  /// has them, and so have details below the base's scale.
  double shortest = 0.05;
  /// Connected curves shorter than this in all are dropped, but for closed ones: a lonely crease on a scan.
  double lonely = 0.2;
  /// How many times sharper than the calmer sides of its faces an edge has to be, by the median along its curve, >= 0:
  /// on a rough surface every edge is sharp. 0 keeps all. From 10 to 20 mechanical parts keep their curves.
  double clarity = 15.0;
  /// Curves whose edges are this many times longer than the steps over every two of them are dropped, > 1: they run in
  /// zigzag beside a crease that the mesh's edges do not follow, as after remeshing, or over a rough surface. Those of
  /// mechanical parts measured up to 1.02, of a remeshed one and of animals 1.08 and more in the mean.
  double ragged = 1.05;
  /// Where all curves together are shorter than this the surface has none: a few creases of a scan, as bunny's 0.3.
  double least = 2.0;
};

/// The curves that feature edges form, each once, in order of their smallest vertex. O(n log n + F log F).
std::vector<FeatureCurve> feature_curves(const Mesh& mesh, const FeatureEdges& edges);

/// The edges of some curves.
FeatureEdges edges_of(const std::vector<FeatureCurve>& curves);

/// Sharp edges by their dihedral angle with hysteresis (as Canny's of image edges; Hubeli and Gross 2001 for meshes),
/// without short loose ends and lonely pieces. The mesh must be manifold. An edge at a face without area is none.
/// Throws Error(BadOption). O(F log F).
FeatureEdges detect_features(const Mesh& mesh, const FeatureOptions& options = {});

/// Edges at or over one dihedral angle, none dropped. `degrees` in (0, 180). Throws Error(BadOption). O(F log F).
FeatureEdges edges_sharper_than(const Mesh& mesh, double degrees);

}  // namespace gsp
