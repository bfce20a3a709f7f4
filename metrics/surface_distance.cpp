#include "metrics/surface_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "metrics/area_sampler.h"
#include "metrics/triangle_tree.h"

namespace gsp {

struct SurfaceTree::Impl {
  TriangleTree tree;
};

SurfaceTree::SurfaceTree(const Mesh& mesh) : impl_(std::make_unique<Impl>(Impl{TriangleTree(mesh)})) {}
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

namespace {

/// Sums over one block of strata. They are added in block order, so the total does not depend on the threads.
struct Partial {
  double distance = 0.0;
  double squared = 0.0;
  double largest = 0.0;      ///< squared distance
  double pair_variance = 0.0;  ///< Σ (d²_2i - d²_2i+1)² over pairs of neighbouring strata
};

/// A group is at most this many times as large as the triangle it is near; measured best from sparse to dense samples.
constexpr double kGroupReach = 2.0;

/// Squared distances of points that follow each other closely. Points are asked in groups as long as a group stays about
/// as small as the triangle it is near: one walk through the tree then serves up to eight points, and where
/// points are farther apart than the triangles each gets its own.
void squared_distances(const TriangleTree& target, const Vec3* points, std::size_t count, double* squared) {
  int hint = target.descend(points[0]);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    const double reach = kGroupReach * target.size(hint);
    PointGroup<kGroupSize> group;
    Vec3 low = points[begin], high = low;
    for (; end < count && end - begin < kGroupSize; ++end) {
      const Vec3& p = points[end];
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      if (end > begin && (high - low).maxCoeff() > reach) break;
      group.set(end - begin, p);
    }
    for (std::size_t i = end - begin; i < kGroupSize; ++i) group.set(i, points[end - 1]);
    double nearest[kGroupSize];
    target.nearest(group, nearest, hint);
    std::copy(nearest, nearest + (end - begin), squared + begin);
  }
}

Partial measure_block(const AreaSampler& sampler, const TriangleTree& target, std::size_t begin, std::size_t end) {
  std::array<Vec3, AreaSampler::kBlock> points;
  std::array<double, AreaSampler::kBlock> squared;
  const std::size_t count = end - begin;
  sampler.sample(begin, end, points.data());
  squared_distances(target, points.data(), count, squared.data());
  Partial sum;
  for (std::size_t i = 0; i < count; ++i) {
    sum.distance += std::sqrt(squared[i]);
    sum.squared += squared[i];
    sum.largest = std::max(sum.largest, squared[i]);
    // A last stratum without a partner is paired with its predecessor.
    if (i % 2 == 1 || (i + 1 == count && i > 0)) {
      const double difference = squared[i] - squared[i - 1];
      sum.pair_variance += difference * difference;
    }
  }
  return sum;
}

OneWayDistance one_way(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                       const DistanceOptions& options, const std::string& stage, Progress& progress) {
  progress.report(stage, 0.0);
  const AreaSampler sampler(from, from_tree.order(), options.samples, options.seed);
  const std::size_t blocks = (options.samples + AreaSampler::kBlock - 1) / AreaSampler::kBlock;
  std::vector<Partial> partials(blocks);
  // In a few rounds, so that progress is told and asked from this thread.
  const std::size_t round = std::max<std::size_t>(64, (blocks + 15) / 16);
  for (std::size_t first = 0; first < blocks; first += round) {
    parallel_for(std::min(round, blocks - first), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = first + begin; b < first + end; ++b)
        partials[b] = measure_block(sampler, to, b * AreaSampler::kBlock,
                                    std::min(options.samples, (b + 1) * AreaSampler::kBlock));
    });
    progress.report(stage, static_cast<double>(std::min(first + round, blocks)) / static_cast<double>(blocks));
  }
  Partial total;
  for (const Partial& p : partials) {
    total.distance += p.distance;
    total.squared += p.squared;
    total.largest = std::max(total.largest, p.largest);
    total.pair_variance += p.pair_variance;
  }
  const auto n = static_cast<double>(options.samples);
  OneWayDistance result;
  result.samples = options.samples;
  result.mean = total.distance / n;
  result.rms = std::sqrt(total.squared / n);
  result.hausdorff = std::sqrt(total.largest);
  // The pairs bound the variance of the mean square from above; the root halves its relative error.
  if (result.rms > 0.0) result.rms_standard_error = std::sqrt(total.pair_variance) / n / (2.0 * result.rms);
  return result;
}

}  // namespace

double SurfaceDistance::rms() const { return std::max(forward.rms, backward.rms); }
double SurfaceDistance::mean() const { return std::max(forward.mean, backward.mean); }
double SurfaceDistance::hausdorff() const { return std::max(forward.hausdorff, backward.hausdorff); }

double SurfaceDistance::psnr_db() const {
  return rms() > 0.0 ? 20.0 * std::log10(diagonal / rms()) : std::numeric_limits<double>::infinity();
}

double SurfaceDistance::standard_error_db() const {
  const OneWayDistance& larger = forward.rms >= backward.rms ? forward : backward;
  return larger.rms > 0.0 ? 20.0 / std::log(10.0) * larger.rms_standard_error / larger.rms : 0.0;
}

SurfaceDistance surface_distance(const Mesh& a, const Mesh& b, const DistanceOptions& options, Progress& progress) {
  return surface_distance(a, SurfaceTree(a), b, options, progress);
}

SurfaceDistance surface_distance(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const DistanceOptions& options,
                                 Progress& progress) {
  if (options.samples < 1) throw Error(Cause::BadOption, "the surface distance needs at least one sample");
  const SurfaceTree tree_b(b);
  SurfaceDistance result;
  result.diagonal = bounding_box_diagonal(a);
  result.forward = one_way(a, tree_a.impl().tree, tree_b.impl().tree, options, "distance forward", progress);
  result.backward = one_way(b, tree_b.impl().tree, tree_a.impl().tree, options, "distance backward", progress);
  return result;
}

}  // namespace gsp
