#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/halfedges.h"
#include "param/map/development.h"
#include "param/map/parameterization.h"
#include "param/map/tolerances.h"

namespace gsp {

namespace {

constexpr double kTolerance = tolerance::kSamePlace;
/// Angle sums of a map with exact transitions are multiples of π/3 apart, so this only has to be wider than the
/// rounding of very short chart edges. Vertices that leave a boundary line by less show in the area sum.
constexpr double kAngleTolerance = 1e-3;

/// Compensated sum (Neumaier): the area check asks for 1e-9 over millions of faces of very different areas.
class Sum {
 public:
  void add(double x) {
    const double next = sum_ + x;
    rest_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
    sum_ = next;
  }
  double value() const { return sum_ + rest_; }

 private:
  double sum_ = 0.0, rest_ = 0.0;
};

/// z less the nearest Eisenstein integer; coordinates too large for a lattice position count as far from all.
double distance_to_lattice(Complex z) {
  const double b = z.imag() / kOmegaIm, a = z.real() - kOmegaRe * b;
  const double nearest_a = std::round(a), nearest_b = std::round(b);
  return std::abs(z - Complex(nearest_a + kOmegaRe * nearest_b, kOmegaIm * nearest_b));
}

/// Whether one lattice motion takes a to a_there and b to b_there.
bool differ_by_lattice_motion(Complex a, Complex b, Complex a_there, Complex b_there) {
  for (int k = 0; k < 6; ++k) {
    const Complex turned_a = omega_power(k) * a;
    if (std::abs((b_there - a_there) - omega_power(k) * (b - a)) <= kTolerance &&
        distance_to_lattice(a_there - turned_a) <= kTolerance)
      return true;
  }
  return false;
}

void check_areas(const Parameterization& map, MapCheck& check) {
  Sum area;
  for (int f = 0; f < map.surface.face_count(); ++f) {
    const auto& c = map.face_corners[f];
    const double a = chart_area(c[0], c[1], c[2]);
    if (!(a > 0.0) && check.flipped_faces++ == 0) check.first_flipped = f;
    area.add(a);
  }
  const double expected = map.base.face_count() * kChartArea;
  check.area_error = expected > 0.0 ? std::abs(area.value() - expected) / expected : std::abs(area.value());
}

void check_angles(const Parameterization& map, const Halfedges& halfedges, MapCheck& check) {
  std::vector<double> angle(map.surface.positions.size(), 0.0);
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto& c = map.face_corners[f];
      const Complex left = c[(k + 1) % 3] - c[k], right = c[(k + 2) % 3] - c[k];
      angle[map.surface.faces[f][k]] +=
          std::atan2(cross(left, right), left.real() * right.real() + left.imag() * right.imag());
    }
  std::vector<int> sectors(map.surface.positions.size(), 0);
  for (const Triangle& t : map.base.faces)
    for (int corner : t) ++sectors[map.base.vertices[corner]];
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    if (halfedges.outgoing[v] < 0) continue;
    const int thirds = sectors[v] > 0 ? sectors[v] : halfedges.boundary_vertex(v) ? 3 : 6;
    const bool right = std::abs(angle[v] - thirds * std::numbers::pi / 3.0) <= kAngleTolerance;
    if (!right && check.wrong_angle_vertices++ == 0) check.first_wrong_angle = v;
  }
}

void check_edges(const Parameterization& map, const Halfedges& halfedges, MapCheck& check) {
  for (int h = 0; h < static_cast<int>(halfedges.twin.size()); ++h) {
    const int t = halfedges.twin[h];
    if (t < h) continue;
    const auto &here = map.face_corners[h / 3], &there = map.face_corners[t / 3];
    const int from = h % 3, from_there = (t % 3 + 1) % 3;
    if (!differ_by_lattice_motion(here[from], here[(from + 1) % 3], there[from_there], there[t % 3]))
      ++check.mismatched_edges;
  }
}

void check_positions(const Parameterization& map, MapCheck& check) {
  std::vector<char> misplaced(map.surface.positions.size(), 0);
  for (int v = 0; v < map.surface.vertex_count(); ++v) {
    if (map.patch[v] < 0) continue;
    for (double weight : chart_barycentric(map.position[v]))
      if (!(weight >= -kTolerance)) misplaced[v] = 1;
  }
  for (int b = 0; b < map.base.vertex_count(); ++b) {
    const int v = map.base.vertices[b];
    if (map.patch[v] < 0) continue;
    bool at_corner = false;
    for (int k = 0; k < 3; ++k)
      at_corner |=
          map.base.faces[map.patch[v]][k] == b && std::abs(map.position[v] - kChartCorners[k].value()) <= kTolerance;
    if (!at_corner) misplaced[v] = 1;
  }
  for (int f = 0; f < map.surface.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int v = map.surface.faces[f][k];
      bool reached = false;
      for (int turn = 0; turn < 6 && !reached; ++turn)
        reached = distance_to_lattice(map.face_corners[f][k] - omega_power(turn) * map.position[v]) <= kTolerance;
      if (!reached) misplaced[v] = 1;
    }
  for (int v = 0; v < map.surface.vertex_count(); ++v)
    if (misplaced[v] && check.misplaced_vertices++ == 0) check.first_misplaced = v;
}

/// Where a point of a face lies: the base face, by the piece of the face that holds it best, and the place in its
/// chart.
struct ChartPlace {
  int chart;
  Complex at;
};

ChartPlace place_of(const std::vector<FacePiece>& pieces, Complex z) {
  ChartPlace best{-1, {}};
  double deepest = 0.0;
  for (const FacePiece& piece : pieces) {
    const Complex at = piece.motion.apply(z);
    const auto w = chart_barycentric(at);
    const double depth = std::min({w[0], w[1], w[2]});
    if (best.chart >= 0 && depth <= deepest) continue;
    deepest = depth;
    best = {piece.chart, at};
  }
  return best;
}

/// Whether two places are the same point, which an edge of the base may lie between.
bool same_place(const BaseComplex& base, const ChartPlace& a, const ChartPlace& b) {
  if (a.chart == b.chart && std::abs(a.at - b.at) <= kTolerance) return true;
  for (int h = 3 * a.chart; h < 3 * a.chart + 3; ++h)
    if (base.twins[h] >= 0 && base.twins[h] / 3 == b.chart && std::abs(base.across(h).apply(a.at) - b.at) <= kTolerance)
      return true;
  return false;
}

void check_places(const Parameterization& map, const Halfedges& halfedges, MapCheck& check) {
  const Development development(map);
  std::vector<FacePiece> here, there;
  const auto middle = [&](int h) {
    return 0.5 * (map.face_corners[h / 3][h % 3] + map.face_corners[h / 3][Halfedges::next(h) % 3]);
  };
  for (int f = 0; f < map.surface.face_count(); ++f) {
    here.clear();
    development.append(f, here);
    for (int h = 3 * f; h < 3 * f + 3; ++h) {
      const int twin = halfedges.twin[h];
      if (twin < h) continue;
      there.clear();
      development.append(twin / 3, there);
      if (same_place(map.base, place_of(here, middle(h)), place_of(there, middle(twin)))) continue;
      if (check.torn_edges++ == 0) check.first_torn = f;
    }
  }
}

}  // namespace

MapCheck check_map(const Parameterization& map) {
  require_well_formed(map);
  const Halfedges halfedges(map.surface);
  MapCheck check;
  check_areas(map, check);
  check_angles(map, halfedges, check);
  check_edges(map, halfedges, check);
  check_positions(map, check);
  if (check.flipped_faces == 0 && check.mismatched_edges == 0) check_places(map, halfedges, check);
  return check;
}

}  // namespace gsp
