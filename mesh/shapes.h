#pragma once

#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {
/// Known shapes for tests, benchmarks and samples. Closed ones are oriented outward, flat ones towards +z.
namespace shapes {

/// Corners of the cube (±1, ±1, ±1); edges of length 2√2.
Mesh tetrahedron();
/// Corners at distance 1 on the axes.
Mesh octahedron();
/// Unit icosahedron, corners on the unit sphere.
Mesh icosahedron();
/// Icosahedron quadrisected `level` >= 0 times, every vertex pushed onto the sphere of the given radius.
Mesh sphere(int level, double radius = 1.0);
/// A sphere with bumps of several sizes: closed, and nowhere so regular that a stage could get away with nothing to do.
Mesh bumpy_sphere(int level);
/// Torus of revolution about the z axis, m x n quads (m, n >= 3) split along one diagonal; major and minor radius.
/// Vertex (i, j), i steps around the axis and j around the tube, is at index j*m + i.
Mesh torus(int m, int n, double major = 1.0, double minor = 0.4);
/// A flat-foldable torus cut from a hexagonal lattice: m x n unit rhombi (m, n >= 3, two equilateral triangles each)
/// with opposite sides joined, vertex (i, j), which is i + jω on the lattice, at index j*m + i. Positions lie on a
/// torus of revolution, but every vertex has valence 6.
Mesh lattice_torus(int m, int n);
/// Flat m x n grid (m, n >= 1) of unit squares split along one diagonal, in the plane z = height; vertex (i, j) is at
/// index j*(m+1) + i.
Mesh grid(int m, int n, double height = 0.0);
/// Disc of `sectors` >= 3 equilateral sectors with side 1 around one centre vertex (index 0), each quadrisected `level`
/// times, flattened into the plane by stretching each sector's angle to 2π / sectors. The corner between sectors s-1
/// and s is at angle 2πs / sectors.
Mesh sector_disc(int sectors, int level);
/// A closed surface of the given genus >= 0: a row of `genus` square holes through a slab, quadrisected `level` times
/// and smoothed a little so that it is not flat.
Mesh genus_slab(int genus, int level);
/// The unit cube, each side two triangles, quadrisected `level` >= 0 times: 12 sharp edges of length 1.
Mesh box(int level);
/// A closed cylinder of radius 1 about the z axis with flat ends at ±1, `sectors` >= 3 around: two sharp rims. Its ends
/// have `sectors` / 4 + 1 rings of faces, its side twice as many.
Mesh cylinder(int sectors);
/// Two equal caps of paraboloids z = ±(1 - r²)/2, joined along the unit circle at 90°: an octahedron quadrisected
/// `level`
/// >= 1 times.
Mesh lens(int level);
/// Two copies of a mesh side by side, as one mesh of twice the components.
Mesh twice(const Mesh& mesh, const Vec3& offset);
/// Every face of a manifold mesh split into four at its edge midpoints; old vertices first, then one per edge in order
/// of first appearance over the faces. Faces are numbered as `SubdivisionLevel` has it. O(F log F).
Mesh quadrisect(const Mesh& mesh);

}  // namespace shapes
}  // namespace gsp
