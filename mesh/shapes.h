#pragma once

#include "mesh/mesh.h"

/// Known shapes for tests, benchmarks and samples.
namespace gsp::shapes {

Mesh tetrahedron();
Mesh octahedron();
/// Unit icosahedron, corners on the unit sphere.
Mesh icosahedron();
/// Icosahedron quadrisected `level` times, every vertex pushed onto the sphere of the given radius.
Mesh sphere(int level, double radius = 1.0);
/// Torus of revolution, m x n quads split along one diagonal; major and minor radius.
Mesh torus(int m, int n, double major = 1.0, double minor = 0.4);
/// A flat-foldable torus cut from a hexagonal lattice: m x n unit rhombi (two equilateral triangles each) with opposite
/// sides joined, vertex (i, j) at index j*m + i. Positions lie on a torus of revolution, but every vertex has valence 6.
Mesh lattice_torus(int m, int n);
/// Flat m x n grid of unit squares split along one diagonal, in the plane z = height.
Mesh grid(int m, int n, double height = 0.0);
/// Disc of `sectors` equilateral sectors around one centre vertex (index 0), each quadrisected `level` times, flattened
/// into the plane by stretching each sector's angle to 2π / sectors.
Mesh sector_disc(int sectors, int level);
/// A closed surface of the given genus: a row of `genus` square holes through a slab, quadrisected `level` times and
/// smoothed a little so that it is not flat.
Mesh genus_slab(int genus, int level);
/// Two copies of a mesh side by side, as one mesh of twice the components.
Mesh twice(const Mesh& mesh, const Vec3& offset);
/// Every face split into four at its edge midpoints; old vertices first, then one per edge.
Mesh quadrisect(const Mesh& mesh);

}  // namespace gsp::shapes
