#include "param/removal/removal_cost.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "param/removal/flatten.h"

namespace gsp {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestRatio = 1e3;       // of lengths and areas, so that degenerate triangles stay comparable
constexpr double kSmallestFlatArea = 1e-9;  // twice the area of a new triangle, the ring's radius being 1
constexpr double kInside = -1e-9;

double bounded(double ratio) { return std::isfinite(ratio) ? std::min(ratio, kLargestRatio) : kLargestRatio; }

double squared(double x) { return x * x; }

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) { return 0.5 * (b - a).cross(c - a).norm(); }

/// Longest edge over inner radius, 1 for the equilateral triangle.
double shape_distortion(double ab, double bc, double ca, double area) {
  const double inner = 2.0 * area / (ab + bc + ca);
  return bounded(std::max({ab, bc, ca}) / inner / (2.0 * std::sqrt(3.0)));
}
}  // namespace

RemovalCost::RemovalCost(const Surface& surface, const NeighbourLists& neighbours, const TriangleComplex& complex,
                         const std::vector<Location>& locations, const std::vector<std::vector<int>>& points,
                         const ParameterizeOptions& options)
    : surface_(surface),
      neighbours_(neighbours),
      complex_(complex),
      locations_(locations),
      points_(points),
      options_(options) {}

/// What the terms of all triangles over the ring share.
void RemovalCost::lay_out(int vertex) {
  const auto& positions = surface_.mesh.positions;
  flatten_star(positions, star_, ring_);
  const int n = star_.size(), sides = static_cast<int>(star_.triangles.size());
  corner_.resize(n);
  corner_area_.resize(n);
  length_.resize(n * n);
  for (int i = 0; i < n; ++i) {
    corner_[i] = positions[star_.ring[i]];
    corner_area_[i] = surface_.vertex_area[star_.ring[i]];
    for (int j = 0; j < i; ++j) length_[i * n + j] = length_[j * n + i] = (corner_[i] - corner_[j]).norm();
  }
  outer_area_.assign(sides, -1.0);
  triangle_flat_.resize(sides);
  for (int k = 0; k < sides; ++k) {
    const int triangle = star_.triangles[k], m = complex_.corner_index(triangle, vertex);
    triangle_flat_[k][m] = 0.0;
    triangle_flat_[k][(m + 1) % 3] = ring_[k];
    triangle_flat_[k][(m + 2) % 3] = ring_[(k + 1) % n];
    const int other = complex_.neighbour(triangle, (m + 1) % 3);
    if (other < 0) continue;
    const Triangle& c = complex_.corners(other);
    outer_area_[k] = triangle_area(positions[c[0]], positions[c[1]], positions[c[2]]);
  }
}

bool RemovalCost::flat_of(int vertex, Complex& flat) const {
  const Location& at = locations_[vertex];
  if (at.triangle < 0) {
    const auto place = std::find(star_.ring.begin(), star_.ring.end(), vertex);
    if (place != star_.ring.end()) flat = ring_[place - star_.ring.begin()];
    if (vertex == star_.center) flat = 0.0;
    return place != star_.ring.end() || vertex == star_.center;
  }
  const auto place = std::find(star_.triangles.begin(), star_.triangles.end(), at.triangle);
  if (place == star_.triangles.end()) return false;
  const auto& corners = triangle_flat_[place - star_.triangles.begin()];
  flat = (1.0 - at.weight1 - at.weight2) * corners[0] + at.weight1 * corners[1] + at.weight2 * corners[2];
  return true;
}

void RemovalCost::add_sample(int vertex, Complex flat, double weight) {
  Sample sample{flat, weight * surface_.vertex_area[vertex], static_cast<int>(edges_.size()), 0};
  const Vec3& here = surface_.mesh.positions[vertex];
  for (int other : neighbours_[vertex]) {
    Complex end;
    if (!flat_of(other, end)) continue;
    const double square = (surface_.mesh.positions[other] - here).squaredNorm();
    edges_.push_back({end - flat, std::sqrt(square), 1.0 / square});
  }
  sample.last_edge = static_cast<int>(edges_.size());
  samples_.push_back(sample);
}

void RemovalCost::collect_samples() {
  samples_.clear();
  edges_.clear();
  int total = 0;
  for (int t : star_.triangles) total += static_cast<int>(points_[t].size());
  const int stride = total / kSamples + 1;
  add_sample(star_.center, 0.0, 1.0);
  int skip = stride / 2;
  for (int t : star_.triangles) {
    const std::vector<int>& points = points_[t];
    for (; skip < static_cast<int>(points.size()); skip += stride) {
      Complex flat;
      flat_of(points[skip], flat);
      add_sample(points[skip], flat, stride);
    }
    skip -= static_cast<int>(points.size());
  }
}

/// What the terms are without samples.
RemovalCost::Terms RemovalCost::outline(const RingTriangle& t) const {
  Terms result;
  const int n = star_.size();
  const Vec3 side1 = corner_[t[1]] - corner_[t[0]], side2 = corner_[t[2]] - corner_[t[0]];
  result.triangle_area = 0.5 * side1.cross(side2).norm();
  result.sigma = shape_distortion(length_[t[0] * n + t[1]], length_[t[1] * n + t[2]], length_[t[2] * n + t[0]],
                                  result.triangle_area);
  // A corner's Voronoi region is shared by the patches around it, six on average.
  result.area = (corner_area_[t[0]] + corner_area_[t[1]] + corner_area_[t[2]]) / 6.0;
  result.undistorted = options_.gamma * squared(result.sigma - 1.0) +
                       options_.mu * squared(outer_dispersion(t, result.triangle_area) - 1.0);
  return result;
}

/// Adds what lies in the triangle to its outline. False, and no terms, as soon as the triangle's cost with `inner` is
/// seen to be no less than `limit`: samples add to the area, δ to the cost, and rounding keeps the order of sums and
/// products of what is not negative.
bool RemovalCost::take_samples(const RingTriangle& t, double inner, double limit, Terms& terms) const {
  if (inner + terms.area * terms.undistorted >= limit) return false;
  const Complex f0 = ring_[t[0]], f1 = ring_[t[1]], f2 = ring_[t[2]];
  const Vec3 side1 = corner_[t[1]] - corner_[t[0]], side2 = corner_[t[2]] - corner_[t[0]];
  // A difference in the plane is side1 and side2 by the weights cross(d, to2) and cross(to1, d).
  const double whole = cross(f1 - f0, f2 - f0);
  const Complex to1 = (f1 - f0) / whole, to2 = (f2 - f0) / whole;
  const Sample* inside[kMostSamples];
  int count = 0;
  for (const Sample& s : samples_) {
    const double w1 = cross(s.flat - f0, to2), w2 = cross(to1, s.flat - f0);
    if (w1 < kInside || w2 < kInside || 1.0 - w1 - w2 < kInside) continue;
    terms.area += s.area;
    inside[count++] = &s;
  }
  if (inner + terms.area * terms.undistorted >= limit) return false;
  const double g11 = side1.squaredNorm(), g12 = 2.0 * side1.dot(side2), g22 = side2.squaredNorm();
  double sum = 0.0, lengths = 0.0;
  for (int i = 0; i < count; ++i) {
    const Sample& s = *inside[i];
    for (int e = s.first_edge; e < s.last_edge; ++e) {
      const double x = cross(edges_[e].flat, to2), y = cross(to1, edges_[e].flat);
      const double stretched = (g11 * x * x + g12 * x * y + g22 * y * y) * edges_[e].inverse_square;
      const double ratio = stretched >= 1.0 ? stretched : 1.0 / stretched;
      sum += (ratio < squared(kLargestRatio) ? ratio : squared(kLargestRatio)) * edges_[e].length;
      lengths += edges_[e].length;
    }
  }
  if (lengths > 0.0) terms.delta = sum / lengths;
  return true;
}

RemovalCost::Terms RemovalCost::terms(const RingTriangle& t) const {
  Terms result = outline(t);
  take_samples(t, 0.0, kInfinity, result);
  return result;
}

double RemovalCost::outer_dispersion(const RingTriangle& t, double area) const {
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

/// Whether the filling may join two vertices of the ring that are not neighbours on it.
bool RemovalCost::is_free_edge(int i, int j) const {
  const int a = star_.ring[i], b = star_.ring[j];
  const bool closing = i == 0 && j == star_.size() - 1;
  if (!chords_ && !closing && complex_.on_boundary(a) && complex_.on_boundary(b)) return false;
  return !complex_.edge_exists(a, b);
}

void RemovalCost::fill_best() {
  const int n = star_.size();
  best_.assign(n * n, kInfinity);
  split_.assign(n * n, -1);
  for (int i = 0; i + 1 < n; ++i) best_[i * n + i + 1] = 0.0;
  for (int span = 2; span < n; ++span)
    for (int i = 0; i + span < n; ++i) {
      const int j = i + span;
      if (barred_[i * n + j]) continue;
      for (int k = i + 1; k < j; ++k) {
        const double inner = best_[i * n + k] + best_[k * n + j];
        if (inner >= best_[i * n + j] || cross(ring_[k] - ring_[i], ring_[j] - ring_[i]) < kSmallestFlatArea) continue;
        const RingTriangle triangle{i, k, j};
        Terms x = outline(triangle);
        if (!take_samples(triangle, inner, best_[i * n + j], x)) continue;
        const double cost = inner + x.area * (x.undistorted + squared(x.delta - 1.0));
        if (cost < best_[i * n + j]) {
          best_[i * n + j] = cost;
          split_[i * n + j] = k;
        }
      }
    }
}

bool RemovalCost::triangulate(Candidate& candidate) {
  const int n = star_.size();
  const auto is_diagonal = [&](int i, int j) { return j - i > 1 && (j - i < n - 1 || star_.boundary); };
  barred_.assign(n * n, 0);
  // Most fillings have no edge that is barred: all edges are looked up where the first try has one.
  for (const bool first : {true, false}) {
    fill_best();
    candidate.triangles.clear();
    if (!(best_[n - 1] < kInfinity)) return false;
    bool barred = false;
    std::vector<std::array<int, 2>> open{{0, n - 1}};
    while (!open.empty()) {
      const auto [i, j] = open.back();
      open.pop_back();
      barred = barred || (first && is_diagonal(i, j) && !is_free_edge(i, j));
      const int k = split_[i * n + j];
      candidate.triangles.push_back({i, k, j});
      if (k - i > 1) open.push_back({i, k});
      if (j - k > 1) open.push_back({k, j});
    }
    if (!barred) break;
    for (int i = 0; i < n; ++i)
      for (int j = i + 2; j < n; ++j) barred_[i * n + j] = is_diagonal(i, j) && !is_free_edge(i, j);
  }
  return true;
}

bool RemovalCost::leaves_surface(const Star& star) const {
  const int n = star.size();
  if (n < 3 || n > kLargestRing || complex_.seams().is_corner(star.center)) return false;
  if (const int other = complex_.seams().other_of(star.center); other >= 0)
    return complex_.component_vertices(star.center) > 4 &&
           complex_.loop_vertices(star.center) > (complex_.on_same_loop(star.center, other) ? 4 : 3);
  return star.boundary ? complex_.loop_vertices(star.center) > 3 : complex_.component_vertices(star.center) > 4;
}

void RemovalCost::price(int vertex, Candidate& candidate) {
  candidate.feasible = false;
  complex_.gather(vertex, star_);
  if (!leaves_surface(star_)) return;
  lay_out(vertex);
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
      if (shared == 2) rho = std::max(rho, bounded(chosen[i].triangle_area / chosen[j].triangle_area));
      if (shared == 2) rho = std::max(rho, bounded(chosen[j].triangle_area / chosen[i].triangle_area));
    }
    candidate.parts.shape += chosen[i].area * options_.gamma * squared(chosen[i].sigma - 1.0);
    candidate.parts.dispersion += chosen[i].area * options_.mu * squared(rho - 1.0);
    candidate.parts.metric += chosen[i].area * squared(chosen[i].delta - 1.0);
  }
  candidate.feasible = true;
}

}  // namespace gsp
