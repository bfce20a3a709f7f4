#pragma once

#include <string>

#include "experiments/curve/curve.h"
#include "metrics/surface_distance.h"

namespace gsp {

/// Measures decoded surfaces against one input, whose search tree is built once.
class Meter {
 public:
  /// Keeps a reference to `mesh`.
  Meter(const Mesh& mesh, const std::string& model, std::uint64_t seed);

  const Mesh& mesh() const { return mesh_; }
  const std::string& model() const { return model_; }

  /// A row with everything filled in that follows from the two surfaces and the byte count.
  CurvePoint measure(const Mesh& decoded, std::size_t bytes, std::size_t samples, Progress& progress) const;

  /// The same where the surface's tree is at hand.
  CurvePoint measure(const Mesh& decoded, const SurfaceTree& tree, std::size_t bytes, std::size_t samples,
                     Progress& progress) const;

 private:
  const Mesh& mesh_;
  std::string model_;
  std::uint64_t seed_;
  SurfaceTree tree_;
};

}  // namespace gsp
