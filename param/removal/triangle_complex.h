#pragma once

#include <array>
#include <vector>

#include "mesh/mesh.h"
#include "param/atlas/surface.h"

namespace gsp {

/// The faces around one vertex of the complex, counter-clockwise. Triangle k spans the centre, ring[k] and ring[k+1];
/// around an interior vertex the ring is a cycle, around a boundary vertex a chain with one triangle fewer.
///
///        ring[2] ------ ring[1]             ring[2] ------ ring[1]
///           / \   t1   / \                     / \   t1   / \         left: inside, six of the
///          /   \      /   \                   /   \      /   \        ring and six triangles
///         / t2  \    /  t0 \                 / t2  \    /  t0 \       right: on a boundary, four
///     ring[3] -- center -- ring[0]       ring[3] -- center -- ring[0]     and three
///         \ t3  /    \  t5 /
///          \   /  t4  \   /
///        ring[4] ------ ring[5]
///
/// Triangle t_k has the slot triangles[k] of the complex. A removal frees these slots; the n - 2 triangles that fill
/// the hole take the first of them.
struct Star {
  int center = -1;
  bool boundary = false;
  std::vector<int> ring;
  std::vector<int> triangles;

  int size() const { return static_cast<int>(ring.size()); }
};

/// Corners of a new triangle as indices into a star's ring, increasing.
using RingTriangle = std::array<int, 3>;

/// A vertex removal of §3.1 and how its hole is filled.
struct Removal {
  int vertex;
  std::vector<RingTriangle> triangles;
};

/// The shrinking complex T^i of §3.1: triangles with neighbours over the surface's vertices. Removing a vertex reuses
/// the slots of its star, so a triangle's index stays valid while it lives.
class TriangleComplex {
 public:
  explicit TriangleComplex(const Surface& surface);

  const Triangle& corners(int triangle) const { return slots_[triangle].corners; }
  bool alive(int triangle) const { return slots_[triangle].corners[0] >= 0; }
  int slot_count() const { return static_cast<int>(slots_.size()); }
  /// Across the edge from corner k to corner k+1; -1 on a boundary.
  int neighbour(int triangle, int k) const { return slots_[triangle].neighbours[k]; }
  /// Index of the vertex in the triangle's corners, -1 if it is none of them.
  int corner_index(int triangle, int vertex) const {
    const Triangle& c = slots_[triangle].corners;
    return c[0] == vertex ? 0 : c[1] == vertex ? 1 : c[2] == vertex ? 2 : -1;
  }
  /// Index of the edge of `triangle` behind which `other` lies, -1 if they are no neighbours.
  int edge_towards(int triangle, int other) const;

  /// The triangle across the edge opposite to a corner; -1 on a boundary.
  int opposite(int triangle, int vertex) const { return neighbour(triangle, (corner_index(triangle, vertex) + 1) % 3); }

  /// Whether the vertex has not been removed.
  bool has(int vertex) const { return incident_[vertex] >= 0; }
  void gather(int vertex, Star& star) const;
  /// Whether an edge joins two vertices, or copies of them; the copies of one vertex count as joined.
  bool edge_exists(int a, int b) const;
  /// How many vertices of the complex the surface's component of a vertex still has, copies counted once and the
  /// component taken whole.
  int component_vertices(int vertex) const { return component_size_[component_[vertex]]; }
  bool on_boundary(int vertex) const { return loop_[vertex] >= 0; }
  /// Vertices left on the boundary loop of a boundary vertex.
  int loop_vertices(int vertex) const { return loop_size_[loop_[vertex]]; }
  bool on_same_loop(int a, int b) const { return loop_[a] == loop_[b]; }
  const Seams& seams() const { return seams_; }

  /// Puts the triangles in place of the star; `slots` receives the slot of each. Slots that are left over die.
  void replace(const Star& star, const std::vector<RingTriangle>& triangles, std::vector<int>& slots);

 private:
  void label_components(const Surface& surface);
  bool edge_at(int a, int b) const;

  struct Slot {
    Triangle corners;
    std::array<int, 3> neighbours;
  };

  std::vector<Slot> slots_;  ///< corners beside neighbours, since a walk around a vertex asks for both
  std::vector<int> incident_;
  std::vector<int> component_, component_size_;
  std::vector<int> loop_, loop_size_;
  Seams seams_;
  std::vector<std::vector<int>> copies_;  ///< per point of the seams, its vertices
};

}  // namespace gsp
