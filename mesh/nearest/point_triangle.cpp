#include "mesh/nearest/point_triangle.h"

#include <Eigen/Geometry>

namespace gsp {

namespace {
/// A unit vector at right angles to the unit vector u.
Vec3 orthogonal(const Vec3& u) {
  int smallest = 0;
  u.cwiseAbs().minCoeff(&smallest);
  return u.cross(Vec3::Unit(smallest)).normalized();
}
}  // namespace

TriangleFrame::TriangleFrame(const Vec3& a, const Vec3& b, const Vec3& c)
    : x_axis(Vec3::UnitX()), y_axis(Vec3::UnitY()) {
  const Vec3* corner[3] = {&a, &b, &c};
  const double squared[3] = {(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()};
  const int longest = static_cast<int>(std::max_element(squared, squared + 3) - squared);
  origin = *corner[longest];
  const Vec3 base = *corner[(longest + 1) % 3] - origin;
  const Vec3 third = *corner[(longest + 2) % 3] - origin;
  length = base.norm();
  if (length == 0.0) return;

  x_axis = base / length;
  x2 = third.dot(x_axis);
  // Orthogonalised twice, since the first difference of a thin triangle is mostly rounding; what is left of less than
  // the rounding of the corners has no direction.
  Vec3 across = third - x2 * x_axis;
  across -= across.dot(x_axis) * x_axis;
  height = across.norm();
  if (height <= 0x1.0p-50 * length) height = 0.0;
  y_axis = height > 0.0 ? Vec3(across / height) : orthogonal(x_axis);
  const double squared1 = (x2 - length) * (x2 - length) + height * height;
  const double squared2 = x2 * x2 + height * height;
  if (squared1 > 0.0) inverse1 = 1.0 / squared1;
  if (squared2 > 0.0) inverse2 = 1.0 / squared2;
}

}  // namespace gsp
