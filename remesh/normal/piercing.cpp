#include "remesh/normal/piercing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/parallel.h"
#include "param/map/base_fan.h"

namespace gsp {

namespace {

/// Outside of a triangle of the domain by less (in areas of charts) is rounding.
constexpr double kOnBorder = 1e-10;

bool inside(const std::array<Complex, 3>& triangle, Complex z) {
  for (int k = 0; k < 3; ++k)
    if (chart_area(triangle[k], triangle[(k + 1) % 3], z) < -kOnBorder) return false;
  return true;
}

ChartBox box_of(const std::array<Complex, 3>& triangle, const Transition& motion) {
  ChartBox box;
  for (Complex z : triangle) box.add(motion.apply(z));
  return box;
}

ChartBox disc_box(Complex centre, double radius) {
  // A step of length r changes a lattice coordinate by at most r over the height of the chart's triangle.
  ChartBox box;
  box.add(centre);
  for (int k = 0; k < 2; ++k) {
    box.low[k] -= radius / kOmegaIm;
    box.high[k] += radius / kOmegaIm;
  }
  return box;
}

}  // namespace

std::optional<std::array<double, 3>> pierce(const Line& line, const std::array<Vec3, 3>& corners) {
  const Vec3 a = corners[0] - line.point, b = corners[1] - line.point, c = corners[2] - line.point;
  // Each is computed alike, but for the sign, in both triangles at the edge.
  std::array<double, 3> w = {line.direction.dot(b.cross(c)), line.direction.dot(c.cross(a)),
                             line.direction.dot(a.cross(b))};
  const double sum = w[0] + w[1] + w[2];
  if (!(w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0 && sum > 0.0) || !std::isfinite(sum)) return std::nullopt;
  for (double& x : w) x /= sum;
  return w;
}

FaceReach::FaceReach(const RemeshDomain& domain) : begin_(domain.connectivity().faces.size() + 1, 0) {
  constexpr std::size_t kBlock = 1024;
  const std::size_t faces = domain.connectivity().faces.size(), blocks = (faces + kBlock - 1) / kBlock;
  std::vector<std::vector<FacePiece>> pieces(blocks);
  parallel_for(faces, kBlock, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::vector<FacePiece> of_face = domain.reach(static_cast<int>(f));
      pieces[begin / kBlock].insert(pieces[begin / kBlock].end(), of_face.begin(), of_face.end());
    }
  });
  for (const std::vector<FacePiece>& block : pieces)
    for (const FacePiece& piece : block) {
      ++begin_[piece.face + 1];
      pieces_.push_back(piece);
    }
  for (std::size_t f = 0; f < faces; ++f) begin_[f + 1] += begin_[f];
}

std::optional<Hit> nearest_hit(const ChartIndex& index, const RemeshDomain& domain, const FaceReach& reach, int edge,
                               const Line& line, Complex expected, double aperture) {
  const Mesh& surface = index.map().surface;
  std::optional<Hit> best;
  double least = aperture * aperture;
  int best_face = std::numeric_limits<int>::max();
  for (int face : domain.connectivity().edge_faces[edge]) {
    if (face < 0) continue;
    const Transition across = domain.across(edge, face);
    const std::array<Complex, 3> triangle = domain.corners(face);
    for (const FacePiece* part = reach.begin(face); part != reach.end(face); ++part) {
      const Transition there = part->motion * across;
      const ChartBox box = box_of(triangle, part->motion).within(disc_box(there.apply(expected), aperture));
      index.for_each_near(part->chart, box, [&](const FacePiece& piece) {
        const Triangle& t = surface.faces[piece.face];
        const std::array<Vec3, 3> corners = {surface.positions[t[0]], surface.positions[t[1]], surface.positions[t[2]]};
        const auto weights = pierce(line, corners);
        if (!weights) return;
        const std::array<Complex, 3> places = index.corners(piece);
        Complex z = 0.0;
        for (int k = 0; k < 3; ++k) z += (*weights)[k] * places[k];
        if (!inside_chart(z) || !inside(triangle, part->motion.inverse().apply(z))) return;
        const Complex here = there.inverse().apply(z);
        const double distance = std::norm(here - expected);
        if (distance > least || (distance == least && piece.face >= best_face)) return;
        least = distance;
        best_face = piece.face;
        Vec3 position = Vec3::Zero();
        for (int k = 0; k < 3; ++k) position += (*weights)[k] * corners[k];
        best = {{domain.home(edge), domain.side(edge), here, part->chart, there}, line.nearest(position)};
      });
    }
  }
  return best;
}

Hit surface_hit(const ChartIndex& index, const RemeshDomain& domain, const FaceReach& reach, int edge, Complex place) {
  // Of the charts that the edge's first face reaches, the one that holds the place best.
  const int face = domain.connectivity().edge_faces[edge][0];
  const FacePiece* best = nullptr;
  double most = 0.0;
  for (const FacePiece* part = reach.begin(face); part != reach.end(face); ++part) {
    const std::array<double, 3> w = chart_barycentric(part->motion.apply(place));
    const double least = std::min({w[0], w[1], w[2]});
    if (best && least <= most) continue;
    best = part;
    most = least;
  }
  const DomainVertex vertex = {domain.home(edge), domain.side(edge), place, best->chart, best->motion};
  const SurfacePoint found = index.at(best->chart, vertex.in_chart());
  const bool creased = domain.connectivity().creased[edge] != 0;
  return {vertex, position_at(index.map().surface, creased ? on_crease(found) : found)};
}

}  // namespace gsp
