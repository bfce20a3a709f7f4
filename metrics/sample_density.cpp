#include "metrics/sample_density.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/parallel.h"
#include "metrics/area_sampler.h"

namespace gsp {

namespace {

/// Pilot samples in one window of the curve that the sampler follows; a window's deviation is one number.
constexpr std::size_t kWindow = 8;
static_assert(AreaSampler::kBlock % kWindow == 0);

double deviation(const double* values) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < kWindow; ++i) sum += values[i];
  const double mean = sum / kWindow;
  for (std::size_t i = 0; i < kWindow; ++i) squares += (values[i] - mean) * (values[i] - mean);
  return std::sqrt(squares / (kWindow - 1));
}

/// The deviation of the squared distance in each window of whole windows of pilot samples.
std::vector<double> window_deviations(const AreaSampler& sampler, const TriangleTree& to) {
  std::vector<double> deviations(sampler.samples() / kWindow);
  const std::size_t count = deviations.size() * kWindow;
  parallel_for(count, AreaSampler::kBlock, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, AreaSampler::kBlock> points;
    std::array<double, AreaSampler::kBlock> squared, weights;
    sampler.sample(begin, end, points.data(), weights.data());
    squared_distances(to, points.data(), end - begin, squared.data());
    for (std::size_t i = 0; i + kWindow <= end - begin; i += kWindow)
      deviations[(begin + i) / kWindow] = deviation(squared.data() + i);
  });
  return deviations;
}

}  // namespace

std::vector<float> sample_density(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to, std::size_t pilot,
                                  std::uint64_t seed) {
  if (pilot < 4 * kWindow) return {};
  const std::vector<int>& order = from_tree.order();
  const std::vector<double> deviations = window_deviations(AreaSampler(from, order, {}, pilot, seed), to);
  // Sums before each window, so that the mean over a face's windows is a difference; each window shares with its
  // neighbours, since what one misses by chance the next may have seen.
  const std::size_t windows = deviations.size();
  std::vector<double> before(windows + 1, 0.0);
  for (std::size_t w = 0; w < windows; ++w) {
    const double left = deviations[w > 0 ? w - 1 : w], right = deviations[w + 1 < windows ? w + 1 : w];
    before[w + 1] = before[w] + 0.25 * left + 0.5 * deviations[w] + 0.25 * right;
  }
  const double mean = before.back() / static_cast<double>(windows);
  if (!(mean > 0.0) || !std::isfinite(mean)) return {};

  const double per_window = surface_area(from) / static_cast<double>(windows);
  const auto window_at = [&](double area) { return std::min(static_cast<std::size_t>(area / per_window), windows - 1); };
  std::vector<float> density(order.size());
  double area = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t first = window_at(area);
    area += face_area(from, order[i]);
    const std::size_t last = window_at(area);
    const double local = (before[last + 1] - before[first]) / static_cast<double>(last + 1 - first);
    density[i] = kLeastDensity + (1.0f - kLeastDensity) * static_cast<float>(local / mean);
  }
  return density;
}

}  // namespace gsp
