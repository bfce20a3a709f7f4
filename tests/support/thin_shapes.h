#pragma once

#include <string>
#include <vector>

#include "mesh/mesh.h"

/// Surfaces whose faces, or whose whole shape, are thin: what CAD tessellations, wires and foils are made of. All are
/// manifold and consistently oriented, without faces of zero area.
namespace gsp::thin_shapes {

/// Closed prism over a regular polygon of radius 1, `rings` >= 1 rows of faces along it; each end is a fan about its
/// middle. The last vertices are the ends' middles.
Mesh rod(int sides, int rings, double length);
/// The same without its ends.
Mesh tube(int sides, int rings, double length);
/// Closed box of 8 vertices and 12 faces.
Mesh box(double x, double y, double z);
/// Cone of radius 1: a tip, and a base of so many sides that is a fan about its middle, or open.
Mesh needle(int sides, double length, bool open);
/// Sphere of radius 1 quadrisected `level` times, scaled along x.
Mesh ellipsoid(int level, double stretch);
/// Flat m x n grid (m, n >= 1) scaled to so long by 1.
Mesh strip(int m, int n, double length);
/// A square plate of side 2 and the given thickness around a round hole of `sides` (a multiple of 4) corners; 0: one
/// flat sheet, open at both rims.
Mesh bored_plate(int sides, double radius, double thickness);
/// Flat disc of so many faces about one vertex, scaled along x.
Mesh fan(int faces, double stretch);
/// Closed: two m x m sheets of side 1, so far apart, and the wall between their rims.
Mesh foil(int m, double gap);
/// A right triangle of base 1 and the given height, as one face.
Mesh triangle(double height);
/// Flat m x m square of side 1 whose rows and columns get narrower towards one corner, each by the same factor, the
/// last 1 / ratio of the first.
Mesh graded_grid(int m, double ratio);
/// Sphere of radius 1 with one vertex drawn out to so far from the middle.
Mesh spike(int level, double length);

struct Shape {
  std::string name;
  Mesh mesh;
};

/// One of each kind for an aspect, largest over smallest extent (or that of the faces), above 1.
std::vector<Shape> family(double aspect);

}  // namespace gsp::thin_shapes
