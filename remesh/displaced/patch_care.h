#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// How far each base face of a displaced remesh goes against breaking, chosen by trial: 0 not at all; from 1 on the
/// remesh's edges count in the fit of the displacements, from 2 on its control points are held to the map's places.
class PatchCare {
 public:
  static constexpr int kMost = 3;

  /// `faces` of the base, all of whose vertices are below `vertex_count`; `areas`, #F, what each weighs.
  PatchCare(int vertex_count, const std::vector<Triangle>& faces, const std::vector<double>& areas);

  /// #F, 0..kMost, of the next trial; at first 0.
  const std::vector<int>& now() const { return now_; }

  /// Takes the mean squared errors, #F, that `now` ended with. Each face then goes as far as where the error of all
  /// that is around it was least so far, or a step farther than ever where its own was much larger than other faces'
  /// there, with the faces around it. False where that is what was tried last. O(F).
  bool learn(const std::vector<double>& errors);

 private:
  struct Trial {
    int care = 0;
    double around = 0.0, error = 0.0;
  };
  double limit(const std::vector<double>& errors) const;

  const int vertex_count_;
  const std::vector<Triangle>& faces_;
  const std::vector<double>& areas_;
  std::vector<int> now_, farthest_;
  std::vector<Trial> best_;
};

}  // namespace gsp
