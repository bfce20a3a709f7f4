#include "remesh/displaced/patch_care.h"

#include <algorithm>
#include <limits>

namespace gsp {

PatchCare::PatchCare(int vertex_count, const std::vector<Triangle>& faces, const std::vector<double>& areas)
    : vertex_count_(vertex_count),
      faces_(faces),
      areas_(areas),
      now_(faces.size(), 0),
      farthest_(faces.size(), 0),
      best_(faces.size(), {0, std::numeric_limits<double>::infinity(), 0.0}) {}

bool PatchCare::learn(const std::vector<double>& errors) {
  // What is done to a face shows in those around it too.
  std::vector<double> at_vertex(vertex_count_, 0.0);
  for (std::size_t f = 0; f < errors.size(); ++f)
    for (int v : faces_[f]) at_vertex[v] += areas_[f] * errors[f];
  const double most = limit(errors);
  std::vector<int> farther(vertex_count_, 0);
  for (std::size_t f = 0; f < errors.size(); ++f) {
    const auto& [a, b, c] = faces_[f];
    const double around = at_vertex[a] + at_vertex[b] + at_vertex[c];
    if (around < best_[f].around) best_[f] = {now_[f], around, errors[f]};
    farthest_[f] = std::max(farthest_[f], now_[f]);
    if (best_[f].error > most && farthest_[f] < kMost)
      for (int v : faces_[f]) farther[v] = std::max(farther[v], farthest_[f] + 1);
  }
  const std::vector<int> before = now_;
  for (std::size_t f = 0; f < errors.size(); ++f) {
    const auto& [a, b, c] = faces_[f];
    now_[f] = std::max({best_[f].care, farther[a], farther[b], farther[c]});
  }
  return now_ != before;
}

double PatchCare::limit(const std::vector<double>& errors) const {
  constexpr double kFar = 50.0;
  // Below, distances are rounding.
  constexpr double kRounding = 1e-28;
  std::vector<double> sorted = errors;
  const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), median, sorted.end());
  return std::max(kFar * *median, kRounding);
}

}  // namespace gsp
