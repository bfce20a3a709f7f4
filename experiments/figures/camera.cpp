#include "experiments/figures/camera.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

#include "mesh/bounding_box.h"
#include "mesh/error.h"

namespace gsp {

namespace {

/// How far the automatic view is turned from the principal axis, in radians.
constexpr double kTurn = 0.35, kLift = 0.2;
/// Sine of the least angle between the line of sight and what points up.
constexpr double kLeastAngle = 1e-6;
/// The same for an automatic up, below which another axis is up.
constexpr double kParallel = 0.3;

/// Direction of least variance of the surface's area, its largest component positive.
Vec3 broad_side(const Mesh& mesh) {
  Vec3 mean = Vec3::Zero();
  double area = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const double a = face_area(mesh, f);
    const Triangle& t = mesh.faces[f];
    mean += a / 3.0 * (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]);
    area += a;
  }
  if (!(area > 0.0)) return Vec3::UnitZ();
  mean /= area;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int f = 0; f < mesh.face_count(); ++f)
    for (int v : mesh.faces[f]) {
      const Vec3 d = mesh.positions[v] - mean;
      covariance += face_area(mesh, f) / (3.0 * area) * d * d.transpose();
    }
  const Vec3 axis = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
  Eigen::Index largest;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0.0 ? Vec3(-axis) : axis;
}

/// The coordinate axis, with its sign, on whose lower end the surface would stand broadest: where the box of the
/// vertices near that end covers most of the box of all, seen along the axis. y, then z where several are as good.
Vec3 standing(const Mesh& mesh) {
  constexpr double kNear = 0.02;  // share of the extent
  const Eigen::AlignedBox3d box = bounding_box(mesh);
  const Vec3 extent = box.sizes().cwiseMax(1e-300);
  Vec3 best = Vec3::UnitY();
  double broadest = 0.0;
  for (int axis : {1, 2, 0})
    for (double sign : {1.0, -1.0}) {
      Eigen::AlignedBox3d foot;
      for (const Triangle& t : mesh.faces)
        for (int v : t) {
          const double height =
              sign > 0.0 ? mesh.positions[v][axis] - box.min()[axis] : box.max()[axis] - mesh.positions[v][axis];
          if (height <= kNear * extent[axis]) foot.extend(mesh.positions[v]);
        }
      const Vec3 share = foot.sizes().cwiseQuotient(extent);
      const double area = share[(axis + 1) % 3] * share[(axis + 2) % 3];
      if (area <= broadest + 0.01) continue;
      broadest = area;
      best = sign * Vec3::Unit(axis);
    }
  return best;
}

Vec3 unit(const Vec3& v, const char* name) {
  if (!(v.norm() > 0.0) || !std::isfinite(v.norm()))
    throw Error(Cause::BadOption, std::string("the direction of ") + name + " has no length");
  return v.normalized();
}

}  // namespace

Camera make_camera(const Mesh& mesh, const View& view) {
  Vec3 up = view.up ? unit(*view.up, "up") : standing(mesh);
  Vec3 toward = view.toward ? unit(*view.toward, "the view") : broad_side(mesh);
  if (!view.up && toward.cross(up).norm() < kParallel) up = std::abs(up.y()) > 0.5 ? Vec3::UnitZ() : Vec3::UnitY();
  if (toward.cross(up).norm() < kLeastAngle) throw Error(Cause::BadOption, "up is parallel to the view");
  if (!view.toward) {
    const Vec3 level = (toward - toward.dot(up) * up).normalized();
    toward = std::cos(kLift) * (Eigen::AngleAxisd(kTurn, up) * level) + std::sin(kLift) * up;
  }
  Camera camera;
  camera.toward = toward;
  camera.right = up.cross(toward).normalized();
  camera.up = toward.cross(camera.right);
  return camera;
}

}  // namespace gsp
