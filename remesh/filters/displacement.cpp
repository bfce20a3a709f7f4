#include "remesh/filters/displacement.h"

#include <algorithm>
#include <cmath>

#include "mesh/error.h"
#include "mesh/fixed_order.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// Multiples of the grid up to here are exact, and their sums.
constexpr double kMostSteps = 1099511627776.0;

void check_control(const SemiregularMesh& mesh) {
  const ControlMesh& control = *mesh.control;
  if (control.points.size() != static_cast<std::size_t>(mesh.base_vertices))
    throw Error(Cause::Malformed, "a displaced mesh has as many control points as base vertices");
  if (!is_control_grid(control.grid)) throw Error(Cause::Malformed, "the control points' grid is none of gsp's");
  require_computable(control.points);
  for (std::size_t b = 0; b < control.points.size(); ++b)
    for (double x : control.points[b]) {
      const double steps = x / control.grid;
      if (!(std::abs(steps) <= kMostSteps) || steps != std::floor(steps))
        throw Error(Cause::Malformed, "a control point does not lie on its grid", Element::Vertex,
                    static_cast<long long>(b));
    }
}

}  // namespace

bool is_control_grid(double grid) {
  if (!std::isfinite(grid) || !(grid > 0.0)) return false;
  int exponent = 0;
  const double mantissa = 8.0 * std::frexp(grid, &exponent);
  return mantissa == std::floor(mantissa) && exponent >= -500 && exponent <= 500;
}

std::vector<Vec3> moves_across(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                               const std::vector<double>& across, AcrossRule rule) {
  std::vector<Vec3> moves(across.size());
  for (std::size_t v = 0; v < moves.size(); ++v)
    for (int k = 0; k < 3; ++k) moves[v][k] = across[v] * surface.conormals[v][k];
  if (rule == AcrossRule::AtBoundary) return moves;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
    for (int e = 0; e < levels[l].edge_count(); ++e) {
      if (levels[l].on_boundary(e)) continue;
      const auto [a, b] = levels[l].edges[e];
      for (int k = 0; k < 3; ++k) moves[levels[l].vertex_count + e][k] = 0.5 * (moves[a][k] + moves[b][k]);
    }
  return moves;
}

std::vector<Vec3> displaced_points(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                                   const Displacements& displacements, AcrossRule rule) {
  const std::vector<Vec3> moves = moves_across(levels, surface, displacements.across, rule);
  std::vector<Vec3> points = surface.points;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int k = 0; k < 3; ++k) points[v][k] += displacements.along[v] * surface.normals[v][k] + moves[v][k];
  return points;
}

Displacements displacements_of(const std::vector<SubdivisionLevel>& levels, const SmoothSurface& surface,
                               const std::vector<Vec3>& positions) {
  Displacements result;
  for (std::size_t v = 0; v < positions.size(); ++v)
    result.across.push_back(dot(surface.conormals[v], positions[v] - surface.points[v]));
  const std::vector<Vec3> moves = moves_across(levels, surface, result.across);
  for (std::size_t v = 0; v < positions.size(); ++v)
    result.along.push_back(dot(surface.normals[v], positions[v] - surface.points[v] - moves[v]));
  return result;
}

DisplacedForm displaced_form(const SemiregularMesh& mesh) {
  check_control(mesh);
  require_computable(mesh.positions);
  const auto levels = subdivision_levels(mesh.base_vertices, mesh.base_faces, mesh.level);
  if (mesh.positions.size() != static_cast<std::size_t>(levels.back().vertex_count))
    throw Error(Cause::Malformed, "a mesh has other vertices than its levels");
  const SmoothSurface surface = smooth_surface(levels, mesh.control->points);
  DisplacedForm form;
  form.displacements = displacements_of(levels, surface, mesh.positions);
  const std::vector<Vec3> again = displaced_points(levels, surface, form.displacements);
  double extent = 0.0;
  for (std::size_t v = 0; v < again.size(); ++v) {
    form.farthest = std::max(form.farthest, (again[v] - mesh.positions[v]).norm());
    extent = std::max(extent, mesh.positions[v].cwiseAbs().maxCoeff());
  }
  if (form.farthest > std::ldexp(extent, -30))
    throw Error(Cause::Malformed, "vertices do not lie on the normals of the control points' surface");
  return form;
}

}  // namespace gsp
