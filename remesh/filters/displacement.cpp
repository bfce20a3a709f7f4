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

std::vector<Vec3> displaced_points(const SmoothSurface& surface, const Displacements& displacements) {
  std::vector<Vec3> points = surface.points;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double along = displacements.along[v], across = displacements.across[v];
    for (int k = 0; k < 3; ++k) points[v][k] += along * surface.normals[v][k] + across * surface.conormals[v][k];
  }
  return points;
}

Displacements displacements_of(const SmoothSurface& surface, const std::vector<Vec3>& positions) {
  Displacements result;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const Vec3 way = positions[v] - surface.points[v];
    result.along.push_back(dot(surface.normals[v], way));
    result.across.push_back(dot(surface.conormals[v], way));
  }
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
  form.displacements = displacements_of(surface, mesh.positions);
  const std::vector<Vec3> again = displaced_points(surface, form.displacements);
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
