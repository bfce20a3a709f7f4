#include "remesh/closest_energy.h"

#include <Eigen/Geometry>

#include "mesh/parallel.h"
#include "remesh/fold_guard.h"

namespace gsp {

ClosestEnergy::ClosestEnergy(const SubdivisionLevel& finest, std::vector<SurfaceSample>& samples,
                             const Springs& springs, const std::vector<Vec3>& start)
    : finest_(finest),
      samples_(samples),
      springs_(springs),
      start_(start),
      inner_(start.size(), 1),
      squared_(samples.size(), 0.0) {
  for (int e = 0; e < finest.edge_count(); ++e)
    if (finest.sharp(e))
      for (int v : finest.edges[e]) inner_[v] = 0;
}

double ClosestEnergy::at(const std::vector<Vec3>& positions) {
  constexpr std::size_t kBlock = 4096;
  parallel_for(samples_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      squared_[i] = walk_to_nearest(finest_, positions, samples_[i].point, samples_[i].place);
  });
  double sum = 0.0;
  for (std::size_t i = 0; i < squared_.size(); ++i) sum += samples_[i].weight * squared_[i];
  of_samples_ = sum;
  for (const auto& [a, b] : finest_.edges)
    sum += springs_.stiffness * (positions[a] - start_[a] - positions[b] + start_[b]).squaredNorm();
  for (std::size_t v = 0; v < positions.size(); ++v) sum += tether(v) * (positions[v] - start_[v]).squaredNorm();
  return sum;
}

VertexSystem ClosestEnergy::linearized(const std::vector<Vec3>& positions) const {
  VertexSystem system(finest_, inner_);
  for (const SurfaceSample& sample : samples_) {
    const Triangle& t = finest_.faces[sample.place.face];
    const Vec3 gap = sample.point - sample.place.at(finest_, positions);
    Vec3 normal = sample.place.inside_face() ? doubled_area(t, positions) : gap;
    const double length = normal.norm();
    if (!(length > 0.0)) continue;
    normal /= length;
    system.add(sample.place.face, sample.place.weights, sample.weight * normal * normal.transpose(),
               sample.weight * gap.dot(normal) * normal);
  }
  for (int e = 0; e < finest_.edge_count(); ++e) {
    const auto [a, b] = finest_.edges[e];
    system.add_spring(e, springs_.stiffness,
                      -springs_.stiffness * (positions[a] - start_[a] - positions[b] + start_[b]));
  }
  for (std::size_t v = 0; v < positions.size(); ++v)
    system.add_spring_to_place(static_cast<int>(v), tether(v), -tether(v) * (positions[v] - start_[v]));
  return system;
}

}  // namespace gsp
