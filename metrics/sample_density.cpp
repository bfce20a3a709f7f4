#include "metrics/sample_density.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "mesh/parallel.h"
#include "metrics/area_sampler.h"

namespace gsp {

namespace {

/// Pilot samples in one window of the curve that the sampler follows; a window's deviation is one number.
constexpr std::size_t kWindow = 8;
static_assert(AreaSampler::kBlock % kWindow == 0);

/// Share of the samples that look where the others are worth most, and how many of them are enough.
constexpr std::size_t kPilotShare = 8, kMostPilots = 1 << 19;
/// Vertices are asked too where they are at most this share of the samples.
constexpr std::size_t kVertexShare = 2;

double deviation(std::span<const double> values) {
  double sum = 0.0, squares = 0.0;
  for (double v : values) sum += v;
  const double mean = sum / static_cast<double>(values.size());
  for (double v : values) squares += (v - mean) * (v - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
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
      deviations[(begin + i) / kWindow] = deviation({squared.data() + i, kWindow});
  });
  return deviations;
}

/// #V squared distance of the vertices of faces, asked in the order in which the tree meets them.
std::vector<double> vertex_squares(const Mesh& mesh, const std::vector<int>& order, const TriangleTree& to) {
  std::vector<int> met;
  met.reserve(mesh.positions.size());
  std::vector<char> seen(mesh.positions.size(), 0);
  for (int face : order)
    for (int v : mesh.faces[face]) {
      if (!seen[v]) met.push_back(v);
      seen[v] = 1;
    }
  std::vector<double> squares(mesh.positions.size(), 0.0);
  constexpr std::size_t kGrain = 1024;
  parallel_for(met.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec3> points(end - begin);
    std::array<double, kGrain> squared;
    for (std::size_t i = begin; i < end; ++i) points[i - begin] = mesh.positions[met[i]];
    squared_distances(to, points.data(), end - begin, squared.data());
    for (std::size_t i = begin; i < end; ++i) squares[met[i]] = squared[i - begin];
  });
  return squares;
}

/// Sums before each window, so that the mean over a face's windows is a difference; each window shares with its
/// neighbours, since what one misses by chance the next may have seen.
std::vector<double> smoothed_sums(const std::vector<double>& deviations) {
  const std::size_t windows = deviations.size();
  std::vector<double> before(windows + 1, 0.0);
  for (std::size_t w = 0; w < windows; ++w) {
    const double left = deviations[w > 0 ? w - 1 : w], right = deviations[w + 1 < windows ? w + 1 : w];
    before[w + 1] = before[w] + 0.25 * left + 0.5 * deviations[w] + 0.25 * right;
  }
  return before;
}

}  // namespace

std::vector<float> sample_density(const Mesh& from, const TriangleTree& from_tree, const TriangleTree& to,
                                  std::size_t samples, std::uint64_t seed) {
  const std::size_t pilot = std::min(samples / kPilotShare, kMostPilots);
  if (pilot < 4 * kWindow) return {};
  const std::vector<int>& order = from_tree.order();
  const AreaSampler sampler(from, order, from_tree.areas(), {}, pilot, seed);
  const std::vector<double> before = smoothed_sums(window_deviations(sampler, to));
  const bool ask_vertices = from.positions.size() <= samples / kVertexShare;
  const std::vector<double> squares = ask_vertices ? vertex_squares(from, order, to) : std::vector<double>();

  const std::size_t windows = before.size() - 1;
  const std::vector<double>& area = sampler.cumulative();
  const double per_window = area.back() / static_cast<double>(windows);
  const auto window_at = [&](double a) { return std::min(static_cast<std::size_t>(a / per_window), windows - 1); };
  std::vector<double> local(order.size());
  constexpr std::size_t kGrain = 8192;
  parallel_for(order.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t first = window_at(area[i]), last = window_at(area[i + 1]);
      local[i] = (before[last + 1] - before[first]) / static_cast<double>(last + 1 - first);
      if (!ask_vertices) continue;
      const auto [a, b, c] = from.faces[order[i]];
      local[i] = std::max(local[i], deviation(std::array{squares[a], squares[b], squares[c]}));
    }
  });
  double mean = 0.0;
  for (std::size_t i = 0; i < local.size(); ++i) mean += (area[i + 1] - area[i]) / area.back() * local[i];
  if (!(mean > 0.0) || !std::isfinite(mean)) return {};
  std::vector<float> density(order.size());
  for (std::size_t i = 0; i < local.size(); ++i)
    density[i] = kLeastDensity + (1.0f - kLeastDensity) * static_cast<float>(local[i] / mean);
  return density;
}

}  // namespace gsp
