#include "metrics/smoothness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <Eigen/LU>

#include "mesh/edge_groups.h"
#include "metrics/singular_values.h"

namespace gsp {

namespace {

using Matrix2 = Eigen::Matrix2d;

/// Where a point counts as inside a base triangle, in barycentric coordinates.
constexpr double kTolerance = 1e-9;

/// An edge and the two faces beside it, everything in the first face's chart.
struct Diamond {
  int first_face, second_face;
  Vec3 from, to, first_apex, second_apex;  ///< on the surface
  Complex z_from, z_to, z_first, z_second;
};

/// Half-edge 3f + k runs from corner k to corner k+1 of face f; the second one runs the other way.
Diamond diamond(const Parameterization& map, int first, int second) {
  const int f = first / 3, k = first % 3, g = second / 3, l = second % 3;
  const auto& t = map.surface.faces;
  const auto& c = map.face_corners;
  Diamond d;
  d.first_face = f;
  d.second_face = g;
  d.from = map.surface.positions[t[f][k]];
  d.to = map.surface.positions[t[f][(k + 1) % 3]];
  d.first_apex = map.surface.positions[t[f][(k + 2) % 3]];
  d.second_apex = map.surface.positions[t[g][(l + 2) % 3]];
  d.z_from = c[f][k];
  d.z_to = c[f][(k + 1) % 3];
  d.z_first = c[f][(k + 2) % 3];
  // The change of chart is the lattice rotation that takes the edge as the second face has it to the first one's.
  const Complex quotient = (d.z_to - d.z_from) / (c[g][l] - c[g][(l + 1) % 3]);
  const int sixths = static_cast<int>(std::lround(std::arg(quotient) / (std::acos(-1.0) / 3.0)));
  d.z_second = d.z_from + omega_power(sixths) * (c[g][(l + 2) % 3] - c[g][(l + 1) % 3]);
  return d;
}

/// Derivative of a face's map, in the plane of the face with the edge along x; `side` is 1 left of the edge, -1 right.
Matrix2 derivative(const Vec3& edge, const Vec3& apex, Complex z_edge, Complex z_apex, double side) {
  const double length = edge.norm(), x = apex.dot(edge) / length;
  Matrix2 surface, chart;
  surface << length, x, 0.0, side * (apex - x / length * edge).norm();
  chart << z_edge.real(), z_apex.real(), z_edge.imag(), z_apex.imag();
  return surface * chart.inverse();
}

struct DerivativeJump {
  double absolute;
  double relative;  ///< to the mean of both derivatives; at most 2
};

DerivativeJump derivative_jump(const Diamond& d) {
  const Vec3 edge = d.to - d.from;
  const Complex z_edge = d.z_to - d.z_from;
  const Matrix2 first = derivative(edge, d.first_apex - d.from, z_edge, d.z_first - d.z_from, 1.0);
  const Matrix2 second = derivative(edge, d.second_apex - d.from, z_edge, d.z_second - d.z_from, -1.0);
  const double jump = (first - second).norm();
  return {jump, jump / (0.5 * (first.norm() + second.norm()))};
}

/// RMS of the jump of a quadratic function in these two triangles, over second derivatives whose components are
/// independent and, as directions do not matter, of twice the variance on the diagonal; in units of that off it.
/// With the edge from 0 to L along x and the apices at (a, h) and (b, -k) the jump is
/// Hxx (a(a-L)/h + b(b-L)/k) / 2 + Hxy (a-b) + Hyy (h+k) / 2.
double quadratic_jump(const Diamond& d) {
  const double length = std::abs(d.z_to - d.z_from);
  const Complex along = (d.z_to - d.z_from) / length;
  const Complex first = (d.z_first - d.z_from) / along, second = (d.z_second - d.z_from) / along;
  const double a = first.real(), h = first.imag(), b = second.real(), k = -second.imag();
  return std::sqrt(0.5 * (std::pow(a * (a - length) / h + b * (b - length) / k, 2) + std::pow(h + k, 2)) +
                   std::pow(a - b, 2));
}

/// Distance in the chart from the middle of the edge to the nearest corner; every corner about is a lattice point.
double corner_distance(const Diamond& d) {
  const Complex z = 0.5 * (d.z_from + d.z_to);
  const double below = std::floor(z.imag() / kOmegaIm);
  double squared = std::numeric_limits<double>::infinity();
  for (const double row : {below, below + 1.0}) {
    const double x = z.real() - kOmegaRe * row, y = z.imag() - kOmegaIm * row;
    squared = std::min(squared, std::pow(x - std::round(x), 2) + y * y);
  }
  return std::sqrt(squared);
}

/// Second derivatives on edges inside and across, by distance from a corner.
class BesideCorners {
 public:
  void add(bool inside, const Diamond& d, Weighted second_derivative) {
    const double distance = corner_distance(d);
    if (!(distance > 0.0)) return;  // in a folded map, an edge may run over a corner: no ring holds its middle
    Ring& ring = rings_[static_cast<int>(std::floor(kRingsPerOctave * std::log2(distance)))];
    (inside ? ring.inside : ring.across).add(second_derivative);
  }

  std::optional<double> across_over_inside() const {
    double excess = 0.0, weight = 0.0;
    for (const auto& [number, ring] : rings_) {
      if (ring.inside.count < kFewest) continue;
      const double expected = ring.inside.sum / ring.inside.weight;
      if (expected <= std::log(2.0 * kNoDerivative)) continue;
      excess += ring.across.sum - ring.across.weight * expected;
      weight += ring.across.weight;
    }
    if (!(weight > 0.0)) return std::nullopt;
    return std::exp(excess / weight);
  }

 private:
  static constexpr double kRingsPerOctave = 4.0;
  static constexpr double kNoDerivative = 1e-7;  ///< below that a second derivative is none
  static constexpr int kFewest = 16;             ///< edges whose mean says something

  struct LogSum {
    double sum = 0.0, weight = 0.0;
    int count = 0;
    void add(const Weighted& w) {
      sum += w.weight * std::log(std::max(w.value, kNoDerivative));
      weight += w.weight;
      ++count;
    }
  };
  struct Ring {
    LogSum inside, across;
  };
  std::map<int, Ring> rings_;
};

bool inside_triangle(const std::array<Complex, 4>& points) {
  return std::all_of(points.begin(), points.end(), [](Complex z) {
    const auto weights = chart_barycentric(z);
    return std::min({weights[0], weights[1], weights[2]}) >= -kTolerance;
  });
}

/// Whether both faces lie in one base triangle: that of the chart or, for faces given in a neighbour's chart, one
/// beside it.
bool in_one_patch(const Parameterization& map, const Diamond& d) {
  const std::array<Complex, 4> points = {d.z_from, d.z_to, d.z_first, d.z_second};
  if (inside_triangle(points)) return true;
  const int chart = map.face_chart[d.first_face];
  for (int k = 0; k < 3; ++k) {
    const int halfedge = 3 * chart + k;
    if (map.base.twins[halfedge] < 0) continue;
    const Transition across = map.base.across(halfedge);
    std::array<Complex, 4> moved;
    std::transform(points.begin(), points.end(), moved.begin(), [&](Complex z) { return across.apply(z); });
    if (inside_triangle(moved)) return true;
  }
  return false;
}

}  // namespace

Smoothness smoothness(const Parameterization& map) {
  require_well_formed(map);
  const std::vector<FaceMap> maps = face_maps(map);
  const double unit = 1.0 / std::sqrt(area_scale(maps));
  std::vector<char> corner(map.surface.positions.size(), 0);
  for (int v : map.base.vertices) corner[v] = 1;
  const auto at_corner = [&](int face) {
    const Triangle& t = map.surface.faces[face];
    return corner[t[0]] || corner[t[1]] || corner[t[2]];
  };

  std::vector<Weighted> inside, across, corners, all;
  BesideCorners beside_corners;
  std::vector<double> length(maps.size(), 0.0);
  Smoothness result;
  result.faces.assign(maps.size(), 0.0);
  const EdgeGroups edges(map.surface);
  for (int e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 2) continue;
    const Diamond d = diamond(map, edges[e][0], edges[e][1]);
    if (!maps[d.first_face].counted() || !maps[d.second_face].counted()) continue;
    const DerivativeJump relative_jump = derivative_jump(d);
    const double jump = unit * relative_jump.absolute;
    const double area = (maps[d.first_face].surface_area + maps[d.second_face].surface_area) / 3.0;
    const Weighted value = {jump, area};
    const bool near_corner = at_corner(d.first_face) || at_corner(d.second_face), in_patch = in_one_patch(map, d);
    (near_corner ? corners : in_patch ? inside : across).push_back(value);
    if (!near_corner) beside_corners.add(in_patch, d, {relative_jump.relative / quadratic_jump(d), area});
    all.push_back(value);
    for (int face : {d.first_face, d.second_face}) {
      result.faces[face] += (d.to - d.from).norm() * jump;
      length[face] += (d.to - d.from).norm();
    }
  }
  for (std::size_t f = 0; f < length.size(); ++f)
    if (length[f] > 0.0) result.faces[f] /= length[f];
  result.inside = statistics(inside);
  result.across = statistics(across);
  result.at_corner = statistics(corners);
  result.all = statistics(all);
  result.inside_edges = static_cast<int>(inside.size());
  result.across_edges = static_cast<int>(across.size());
  result.corner_edges = static_cast<int>(corners.size());
  result.across_over_inside = beside_corners.across_over_inside();
  return result;
}

}  // namespace gsp
