#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// Area-stratified points on a surface. The faces' areas, laid end to end in a given order, are cut into equal strata;
/// each stratum holds one point, uniform in it. Inside a face the line of its area is wound into the triangle along the
/// Sierpinski curve (repeated bisection), which keeps area: so strata are compact even in faces much larger than they
/// are, and neighbours on the line are neighbours on the surface. A density stretches the line where samples are wanted
/// more; each sample then stands for less area there.
class AreaSampler {
 public:
  /// `order`: #F, the faces in the order in which they are sampled, kept by reference as the mesh is; `areas`: theirs,
  /// in that order. `samples` >= 1.
  /// `density`: #F in that order, positive samples per area up to a common factor; empty for the same everywhere.
  /// Throws Error(NoFaces) where no face has area.
  AreaSampler(const Mesh& mesh, const std::vector<int>& order, const std::vector<double>& areas,
              std::vector<float> density, std::size_t samples, std::uint64_t seed);

  /// Points of the strata [begin, end) into out[0..end-begin), and the areas they stand for, in units of the mean one,
  /// into weight[0..end-begin). `begin` is a multiple of kBlock, since the random numbers of each such block are its
  /// own. Any thread.
  void sample(std::size_t begin, std::size_t end, Vec3* out, double* weight) const;

  std::size_t samples() const { return samples_; }
  /// #F+1, area times density of the faces before each place of the order.
  const std::vector<double>& cumulative() const { return cumulative_; }

  static constexpr std::size_t kBlock = 4096;

 private:
  const Mesh& mesh_;
  const std::vector<int>& order_;
  std::vector<float> density_;
  /// A face and where its part of the line begins.
  struct Span;
  Span span(std::size_t place) const;
  std::size_t place_of(double target) const;

  std::vector<double> cumulative_;
  double density_scale_ = 1.0;  ///< mean over area of the density
  std::size_t samples_;
  std::uint64_t seed_;
};

}  // namespace gsp
