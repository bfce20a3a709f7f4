#pragma once

#include <vector>

#include "remesh/nearest_place.h"
#include "remesh/semiregular.h"
#include "remesh/vertex_system.h"

namespace gsp {

/// A point of the surface that stands for `weight` of a face of the remesh, and its place on that by the map.
struct SurfaceSample {
  Vec3 point;
  double weight = 0.0;
  LevelPlace place;
};

/// How a remesh's vertices are held together while they are moved to where the surface is. All in units of the samples'
/// weight over one face, > 0 or 0.
struct Springs {
  double stiffness;              ///< between the moves of an edge's ends
  double tether = 1e-4;          ///< to where each vertex was: moves along a plane, which no sample minds, stay zero
  double boundary_tether = 0.0;  ///< the same, on top, of vertices on boundaries and creases
};

/// The sum of the squared distances of samples to the nearest places of a level's surface, and of springs between the
/// moves of its vertices from `start`: moves that are alike cost nothing.
class ClosestEnergy {
 public:
  /// `finest`, `samples` and `start`, #V, are kept by reference. Samples are expected within a few units of 0.
  ClosestEnergy(const SubdivisionLevel& finest, std::vector<SurfaceSample>& samples, const Springs& springs,
                const std::vector<Vec3>& start);

  /// #V, those that are not on a boundary or crease.
  const std::vector<char>& inner() const { return inner_; }
  /// With the vertices at `positions`, #V. Also moves the samples to their nearest places there, on all threads.
  double at(const std::vector<Vec3>& positions);
  /// Of the last `at`, the part of the samples.
  double of_samples() const { return of_samples_; }
  /// To second order about `positions`, for which `at` was called last: exact to the first, and of the second what a
  /// plane has (iterated closest points, each to the plane of its nearest face).
  VertexSystem linearized(const std::vector<Vec3>& positions) const;

 private:
  double tether(std::size_t vertex) const {
    return springs_.tether + (inner_[vertex] ? 0.0 : springs_.boundary_tether);
  }

  const SubdivisionLevel& finest_;
  std::vector<SurfaceSample>& samples_;
  const Springs springs_;
  const std::vector<Vec3>& start_;
  std::vector<char> inner_;
  std::vector<double> squared_;  ///< distances of the samples
  double of_samples_ = 0.0;
};

}  // namespace gsp
