#include "metrics/psnr.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/bounding_box.h"
#include "mesh/error.h"
#include "mesh/parallel.h"
#include "metrics/area_sampler.h"
#include "metrics/surface_tree_impl.h"

namespace gsp {

namespace {

double longest_side(const Mesh& mesh) { return bounding_box(mesh).sizes().maxCoeff(); }

double mpeg_db(double peak, double mean_square, double rounding) {
  return mean_square > rounding * rounding ? 10.0 * std::log10(3.0 * peak * peak / mean_square)
                                           : std::numeric_limits<double>::infinity();
}

/// Mean over even samples of the squared distance to the plane of the nearest face.
double mean_squared_plane_distance(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                                   const DistanceOptions& options) {
  const AreaSampler sampler(from, from_tree.order(), from_tree.areas(), {}, options.samples, options.seed);
  std::vector<double> sums((options.samples + AreaSampler::kBlock - 1) / AreaSampler::kBlock, 0.0);
  parallel_for(options.samples, AreaSampler::kBlock, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, AreaSampler::kBlock> points;
    std::array<double, AreaSampler::kBlock> weights;
    sampler.sample(begin, end, points.data(), weights.data());
    int place = to.descend(points[0]);
    double sum = 0.0;
    for (std::size_t i = 0; i < end - begin; ++i) {
      to.nearest(points[i], place);
      sum += to.squared_plane_distance(place, points[i]);
    }
    sums[begin / AreaSampler::kBlock] = sum;
  });
  double total = 0.0;
  for (double s : sums) total += s;
  return total / static_cast<double>(options.samples);
}

}  // namespace

Psnr diagonal_psnr(const SurfaceDistance& distance) {
  return {"PSNR of the bounding-box diagonal", "20 log10(diagonal of the first's bounding box / larger RMS)",
          distance.diagonal, distance.psnr_db()};
}

Psnr mpeg_d1_psnr(const Mesh& reference, const SurfaceDistance& distance) {
  const double peak = longest_side(reference);
  return {"MPEG D1 (point to point)",
          "10 log10(3 peak^2 / larger mean square), peak the longest side of the first's box", peak,
          mpeg_db(peak, distance.rms() * distance.rms(), distance.rounding)};
}

Psnr mpeg_d2_psnr(const Mesh& reference, const SurfaceTree& reference_tree, const Mesh& other,
                  const SurfaceTree& other_tree, const DistanceOptions& options, Progress& progress) {
  if (options.samples < 1) throw Error(Cause::BadOption, "the surface distance needs at least one sample");
  const TriangleTree &to = other_tree.impl().tree, &from = reference_tree.impl().tree;
  progress.report("point to plane", 0.0);
  const double forward = mean_squared_plane_distance(reference, from, to, options);
  progress.report("point to plane", 0.5);
  const double backward = mean_squared_plane_distance(other, to, from, options);
  const double peak = longest_side(reference);
  return {"MPEG D2 (point to plane)",
          "10 log10(3 peak^2 / larger mean square along the nearest face's normal), peak the longest side of the "
          "first's box",
          peak, mpeg_db(peak, std::max(forward, backward), distance_rounding(reference, other))};
}

}  // namespace gsp
