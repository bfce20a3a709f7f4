#include "param/omega.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "param/flatten.h"

namespace gsp {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestRatio = 1e3;   // of lengths and areas, so that degenerate triangles stay comparable
constexpr double kSmallestFlatArea = 1e-9;  // twice the area of a new triangle, the ring's radius being 1
constexpr double kInside = -1e-9;

double bounded(double ratio) { return std::isfinite(ratio) ? std::min(ratio, kLargestRatio) : kLargestRatio; }

double squared(double x) { return x * x; }

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

/// Longest edge over inner radius, 1 for the equilateral triangle.
double shape_distortion(const Vec3& a, const Vec3& b, const Vec3& c, double area) {
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  const double inner = 2.0 * area / (ab + bc + ca);
  return bounded(std::max({ab, bc, ca}) / inner / (2.0 * std::sqrt(3.0)));
}
}  // namespace

Pricer::Pricer(const Surface& surface, const TriangleComplex& complex, const std::vector<Location>& locations,
               const std::vector<std::vector<int>>& points, const ParameterizeOptions& options)
    : surface_(surface), complex_(complex), locations_(locations), points_(points), options_(options) {}

bool Pricer::flat_of(int vertex, Complex& flat) const {
  if (vertex == star_.center) {
    flat = 0.0;
    return true;
  }
  const int n = star_.size();
  const Location& at = locations_[vertex];
  if (at.triangle < 0) {
    for (int k = 0; k < n; ++k)
      if (star_.ring[k] == vertex) {
        flat = ring_[k];
        return true;
      }
    return false;
  }
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    if (star_.triangles[k] != at.triangle) continue;
    flat = flat_in_star(complex_, star_, ring_, static_cast<int>(k), at);
    return true;
  }
  return false;
}

Complex Pricer::flat_position(int vertex) const {
  Complex flat = 0.0;
  flat_of(vertex, flat);
  return flat;
}

void Pricer::add_sample(int vertex, double weight) {
  Sample sample{flat_position(vertex), weight * surface_.vertex_area[vertex], static_cast<int>(edges_.size()), 0};
  const Vec3& here = surface_.mesh.positions[vertex];
  surface_.for_each_neighbour(vertex, [&](int other, int, bool) {
    Complex flat;
    if (flat_of(other, flat)) edges_.push_back({flat - sample.flat, (surface_.mesh.positions[other] - here).norm()});
  });
  sample.last_edge = static_cast<int>(edges_.size());
  samples_.push_back(sample);
}

void Pricer::collect_samples() {
  samples_.clear();
  edges_.clear();
  int total = 0;
  for (int t : star_.triangles) total += static_cast<int>(points_[t].size());
  const int stride = total / kSamples + 1;
  add_sample(star_.center, 1.0);
  int skip = stride / 2;
  for (int t : star_.triangles) {
    const std::vector<int>& points = points_[t];
    for (; skip < static_cast<int>(points.size()); skip += stride) add_sample(points[skip], stride);
    skip -= static_cast<int>(points.size());
  }
}

Pricer::Terms Pricer::terms(const RingTriangle& t) const {
  Terms result;
  const auto& positions = surface_.mesh.positions;
  const int v0 = star_.ring[t[0]], v1 = star_.ring[t[1]], v2 = star_.ring[t[2]];
  const Complex f0 = ring_[t[0]], f1 = ring_[t[1]], f2 = ring_[t[2]];
  const Vec3 side1 = positions[v1] - positions[v0], side2 = positions[v2] - positions[v0];
  result.triangle_area = triangle_area(positions[v0], positions[v1], positions[v2]);
  result.sigma = shape_distortion(positions[v0], positions[v1], positions[v2], result.triangle_area);
  // A corner's Voronoi region is shared by the patches around it, six on average.
  result.area = (surface_.vertex_area[v0] + surface_.vertex_area[v1] + surface_.vertex_area[v2]) / 6.0;
  const double whole = cross(f1 - f0, f2 - f0);
  double sum = 0.0, lengths = 0.0;
  for (const Sample& s : samples_) {
    const double w1 = cross(s.flat - f0, f2 - f0) / whole, w2 = cross(f1 - f0, s.flat - f0) / whole;
    if (w1 < kInside || w2 < kInside || 1.0 - w1 - w2 < kInside) continue;
    result.area += s.area;
    for (int e = s.first_edge; e < s.last_edge; ++e) {
      const Complex d = edges_[e].flat;
      const double mapped = (cross(d, f2 - f0) / whole * side1 + cross(f1 - f0, d) / whole * side2).norm();
      const double ratio = std::max(edges_[e].length / mapped, mapped / edges_[e].length);
      sum += squared(bounded(ratio)) * edges_[e].length;
      lengths += edges_[e].length;
    }
  }
  if (lengths > 0.0) result.delta = sum / lengths;
  return result;
}

double Pricer::outer_dispersion(const RingTriangle& t, double area) const {
  double rho = 1.0;
  const int n = star_.size();
  for (int k = 0; k < 3; ++k) {
    const int a = t[k], b = t[(k + 1) % 3];
    if ((a + 1) % n != b || (star_.boundary && b == 0)) continue;
    const double other = outer_area_[a];
    if (other >= 0.0) rho = std::max(rho, bounded(std::max(area / other, other / area)));
  }
  return rho;
}

bool Pricer::triangulate(Candidate& candidate) {
  const int n = star_.size();
  best_.assign(n * n, kInfinity);
  split_.assign(n * n, -1);
  for (int i = 0; i + 1 < n; ++i) best_[i * n + i + 1] = 0.0;
  for (int span = 2; span < n; ++span)
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      const bool diagonal = span < n - 1 || star_.boundary;
      if (diagonal && complex_.edge_exists(star_.ring[i], star_.ring[j])) continue;
      if (!chords_ && span < n - 1 && complex_.on_boundary(star_.ring[i]) && complex_.on_boundary(star_.ring[j])) continue;
      for (int k = i + 1; k < j; ++k) {
        const double inner = best_[i * n + k] + best_[k * n + j];
        if (inner >= best_[i * n + j] || cross(ring_[k] - ring_[i], ring_[j] - ring_[i]) < kSmallestFlatArea) continue;
        const RingTriangle triangle{i, k, j};
        const Terms x = terms(triangle);
        const double rho = outer_dispersion(triangle, x.triangle_area);
        const double cost = inner + x.area * (options_.gamma * squared(x.sigma - 1.0) +
                                              options_.mu * squared(rho - 1.0) + squared(x.delta - 1.0));
        if (cost < best_[i * n + j]) {
          best_[i * n + j] = cost;
          split_[i * n + j] = k;
        }
      }
    }
  candidate.triangles.clear();
  if (!(best_[n - 1] < kInfinity)) return false;
  std::vector<std::array<int, 2>> open{{0, n - 1}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const int k = split_[i * n + j];
    candidate.triangles.push_back({i, k, j});
    if (k - i > 1) open.push_back({i, k});
    if (j - k > 1) open.push_back({k, j});
  }
  return true;
}

bool Pricer::leaves_surface(const Star& star) const {
  const int n = star.size();
  if (n < 3 || n > kLargestRing) return false;
  return star.boundary ? complex_.loop_vertices(star.center) > 3 : complex_.component_vertices(star.center) > 4;
}

void Pricer::price(int vertex, Candidate& candidate) {
  candidate.feasible = false;
  complex_.gather(vertex, star_);
  if (!leaves_surface(star_)) return;
  flatten_star(surface_.mesh.positions, star_, ring_);
  const auto& positions = surface_.mesh.positions;
  outer_area_.assign(star_.triangles.size(), -1.0);
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    const int other = complex_.opposite(star_.triangles[k], vertex);
    if (other < 0) continue;
    const Triangle& c = complex_.corners(other);
    outer_area_[k] = triangle_area(positions[c[0]], positions[c[1]], positions[c[2]]);
  }
  collect_samples();
  if (!triangulate(candidate)) return;

  candidate.parts = {};
  std::vector<Terms> chosen;
  for (const RingTriangle& t : candidate.triangles) chosen.push_back(terms(t));
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const RingTriangle& t = candidate.triangles[i];
    double rho = outer_dispersion(t, chosen[i].triangle_area);
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      if (j == i) continue;
      int shared = 0;
      for (int a : t)
        for (int b : candidate.triangles[j]) shared += a == b;
      if (shared == 2)
        rho = std::max(rho, bounded(chosen[i].triangle_area / chosen[j].triangle_area));
      if (shared == 2)
        rho = std::max(rho, bounded(chosen[j].triangle_area / chosen[i].triangle_area));
    }
    candidate.parts.shape += chosen[i].area * options_.gamma * squared(chosen[i].sigma - 1.0);
    candidate.parts.dispersion += chosen[i].area * options_.mu * squared(rho - 1.0);
    candidate.parts.metric += chosen[i].area * squared(chosen[i].delta - 1.0);
  }
  candidate.feasible = true;
}

}  // namespace gsp
