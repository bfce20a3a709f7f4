#include "metrics/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "metrics/sampled_distance.h"
#include "metrics/surface_tree_impl.h"

namespace gsp {

SurfaceTree::SurfaceTree(const Mesh& mesh) : impl_(std::make_unique<Impl>(Impl{TriangleTree(mesh)})) {}
SurfaceTree::SurfaceTree(const Mesh& mesh, const SurfaceTree& like)
    : impl_(std::make_unique<Impl>(Impl{TriangleTree(mesh, like.impl().tree)})) {}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

double SurfaceTree::squared_distance(const Vec3& p, int& hint) const {
  const TriangleTree& tree = impl_->tree;
  int place = hint >= 0 ? tree.place(hint) : tree.descend(p);
  const double squared = tree.nearest(p, place);
  hint = tree.order()[place];
  return squared;
}

double SurfaceDistance::rms() const { return std::max(forward.rms, backward.rms); }
double SurfaceDistance::mean() const { return std::max(forward.mean, backward.mean); }
double SurfaceDistance::quantile95() const { return std::max(forward.quantile95, backward.quantile95); }
double SurfaceDistance::hausdorff() const { return std::max(forward.hausdorff, backward.hausdorff); }

double SurfaceDistance::psnr_db() const {
  return exact() ? std::numeric_limits<double>::infinity() : 20.0 * std::log10(diagonal / rms());
}

double OneWayDistance::standard_error_db() const {
  return rms > 0.0 ? 20.0 / std::log(10.0) * rms_standard_error / rms : 0.0;
}

double SurfaceDistance::standard_error_db() const {
  return (forward.rms >= backward.rms ? forward : backward).standard_error_db();
}

double distance_rounding(const Mesh& a, const Mesh& b) {
  constexpr double kRounding = 1e-13;
  double largest = 0.0;
  for (const Mesh* mesh : {&a, &b})
    for (const Triangle& face : mesh->faces)
      for (int v : face) largest = std::max(largest, mesh->positions[v].cwiseAbs().maxCoeff());
  return kRounding * largest;
}

SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options, Progress& progress) {
  return surface_distance(a, SurfaceTree(a), b, options, progress);
}

SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b,
                                 const DistanceOptions& options, Progress& progress) {
  return surface_distance(a, tree_a, b, SurfaceTree(b), options, progress);
}

SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                                 const DistanceOptions& options, Progress& progress) {
  if (options.samples < 1) throw Error(Cause::BadOption, "the surface distance needs at least one sample");
  if (!(options.tolerance_db >= 0.0))
    throw Error(Cause::BadOption, "the tolerance is a number of decibels, at least 0");
  SurfaceDistance result;
  result.diagonal = bounding_box_diagonal(a);
  result.rounding = distance_rounding(a, b);
  const TriangleTree &a_tree = tree_a.impl().tree, &b_tree = tree_b.impl().tree;
  result.forward = sampled_distance(a, a_tree, b_tree, result.diagonal, options, "distance forward", progress);
  result.backward = sampled_distance(b, b_tree, a_tree, result.diagonal, options, "distance backward", progress);
  return result;
}

std::vector<double> vertex_distances(const Mesh& from, const SurfaceTree& to) {
  std::vector<double> distances(from.positions.size());
  constexpr std::size_t kGrain = 4096;
  parallel_for(distances.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    squared_distances(to.impl().tree, from.positions.data() + begin, end - begin, distances.data() + begin);
    for (std::size_t i = begin; i < end; ++i) distances[i] = std::sqrt(distances[i]);
  });
  return distances;
}

}  // namespace gsp
