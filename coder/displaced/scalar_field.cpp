#include "coder/displaced/scalar_field.h"

#include <algorithm>
#include <cmath>

#include "coder/quantizer.h"
#include "mesh/fixed_order.h"

namespace gsp {

namespace {

/// Levels whose edges carry details.
std::vector<SubdivisionLevel> detail_levels(const std::vector<SubdivisionLevel>& levels) {
  return {levels.begin(), levels.end() - 1};
}

/// #V, a third of the area of the faces around each vertex.
std::vector<double> vertex_areas(const SubdivisionLevel& level, const std::vector<Vec3>& points) {
  std::vector<double> areas(level.vertex_count, 0.0);
  for (const auto& [a, b, c] : level.faces) {
    const Vec3 doubled = cross(points[b] - points[a], points[c] - points[a]);
    const double share = std::sqrt(dot(doubled, doubled)) / 6.0;
    for (int v : {a, b, c}) areas[v] += share;
  }
  return areas;
}

}  // namespace

ScalarField::ScalarField(const std::vector<SubdivisionLevel>& levels, const ScalarForest& forest, Wavelet wavelet)
    : levels_(levels),
      forest_(forest),
      along_(detail_levels(levels), wavelet),
      across_(detail_levels(levels), Wavelet::Butterfly),
      base_weight_(1.0 / wavelet_norm(wavelet)) {}

std::vector<double> ScalarField::analysis(const Displacements& displacements) const {
  std::vector<double> coefficients(forest_.nodes());
  std::vector<Vec3> along(forest_.vertices, Vec3::Zero()), across = along;
  for (int v = 0; v < forest_.vertices; ++v) along[v][0] = displacements.along[v];
  for (int n = forest_.vertices; n < forest_.nodes(); ++n)
    across[forest_.vertex[n]][0] = displacements.across[forest_.vertex[n]];
  std::vector<double> across_details(forest_.vertices, 0.0);
  for (std::size_t l = levels_.size() - 1; l-- > 0;) {
    const WaveletTransform::Split split = along_.analysis(static_cast<int>(l), along);
    const WaveletTransform::Split beside = across_.analysis(static_cast<int>(l), across);
    for (int e = 0; e < levels_[l].edge_count(); ++e) {
      coefficients[levels_[l].vertex_count + e] = split.details[e][0];
      across_details[levels_[l].vertex_count + e] = beside.details[e][0];
    }
    along = split.coarse;
    across = beside.coarse;
  }
  for (int v = 0; v < levels_.front().vertex_count; ++v) {
    coefficients[v] = along[v][0];
    across_details[v] = across[v][0];
  }
  for (int n = forest_.vertices; n < forest_.nodes(); ++n) coefficients[n] = across_details[forest_.vertex[n]];
  return coefficients;
}

Displacements ScalarField::synthesis(const std::vector<double>& coefficients) const {
  const int base = levels_.front().vertex_count;
  std::vector<double> across_details(forest_.vertices, 0.0);
  for (int n = forest_.vertices; n < forest_.nodes(); ++n) across_details[forest_.vertex[n]] = coefficients[n];
  std::vector<Vec3> along(base, Vec3::Zero()), across = along;
  for (int v = 0; v < base; ++v) {
    along[v][0] = coefficients[v];
    across[v][0] = across_details[v];
  }
  for (std::size_t l = 0; l + 1 < levels_.size(); ++l) {
    const SubdivisionLevel& level = levels_[l];
    std::vector<Vec3> details(level.edge_count(), Vec3::Zero()), beside = details;
    for (int e = 0; e < level.edge_count(); ++e) {
      details[e][0] = coefficients[level.vertex_count + e];
      beside[e][0] = across_details[level.vertex_count + e];
    }
    along = along_.synthesis(static_cast<int>(l), std::move(along), details);
    across = across_.synthesis(static_cast<int>(l), std::move(across), beside);
    for (int e = 0; e < level.edge_count(); ++e)
      if (level.edge_faces[e][1] >= 0) across[level.vertex_count + e].setZero();
  }
  Displacements displacements;
  for (int v = 0; v < forest_.vertices; ++v) {
    displacements.along.push_back(along[v][0]);
    displacements.across.push_back(across[v][0]);
  }
  return displacements;
}

std::vector<double> ScalarField::weights(const std::vector<Vec3>& control, int area_level, int stream_level) const {
  // In units of the extent, a power of two, so that no area over- or underflows.
  double extent = 0.0;
  for (const Vec3& p : control)
    for (int k = 0; k < 3; ++k) extent = std::max(extent, std::abs(p[k] - control[0][k]));
  const int exponent = extent > 0.0 ? std::ilogb(extent) : 0;
  std::vector<Vec3> scaled = control;
  for (Vec3& p : scaled)
    for (int k = 0; k < 3; ++k) p[k] = std::ldexp(p[k] - control[0][k], -exponent);
  const std::vector<SubdivisionLevel> levels(levels_.begin(), levels_.begin() + area_level + 1);
  std::vector<double> areas = vertex_areas(levels.back(), smooth_surface(levels, scaled).points);
  double mean = 0.0;
  for (double area : areas) mean += area;
  mean /= static_cast<double>(areas.size());
  mean = std::ldexp(mean, -2 * (stream_level - area_level));
  if (!(mean > 0.0)) return std::vector<double>(forest_.nodes(), 1.0);

  // Finer levels: each vertex has a quarter of what those around it had.
  std::vector<double> here = areas;
  areas.resize(forest_.vertices);
  for (std::size_t l = area_level; l + 1 < levels_.size(); ++l) {
    for (double& area : here) area /= 4.0;
    for (const auto& [a, b] : levels_[l].edges) {
      here.push_back((here[a] + here[b]) / 2.0);
      areas[here.size() - 1] = here.back();
    }
  }
  // Coarser ones: an edge's vertex leaves its area to the edge's ends.
  for (std::size_t l = area_level; l-- > 0;) {
    const SubdivisionLevel& level = levels_[l];
    for (int e = 0; e < level.edge_count(); ++e)
      for (int end : level.edges[e]) areas[end] += areas[level.vertex_count + e] / 2.0;
  }
  // A surface that vanishes somewhere still has coefficients there.
  constexpr double kLeast = 1.0 / 64.0, kAcross = 0.25;
  std::vector<double> weights(forest_.nodes());
  for (int n = 0; n < forest_.nodes(); ++n) {
    const int v = forest_.vertex[n];
    const double weight = std::max(std::sqrt(areas[v] / mean), kLeast);
    weights[n] =
        weight * (v < levels_.front().vertex_count ? base_weight_ : 1.0) * (n < forest_.vertices ? 1.0 : kAcross);
  }
  return weights;
}

}  // namespace gsp
