#include "param/shortening.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Dense>

namespace gsp {

namespace {

constexpr double kLongest = 12.0;     // length over width of the image
constexpr double kFacingAxis = 1e-3;  // of its size, less than which a face's extent along the axis is not its length

/// Principal directions of the faces' corners by area, the longest last.
Eigen::Matrix3d principal_axes(const Mesh& mesh, const Vec3& middle) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int f = 0; f < mesh.face_count(); ++f) {
    const double area = face_area(mesh, f);
    for (int v : mesh.faces[f]) {
      const Vec3 p = mesh.positions[v] - middle;
      covariance += area * p * p.transpose();
    }
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
}

}  // namespace

Shortening::Shortening(const Mesh& mesh) {
  double area = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    const double more = face_area(mesh, f);
    area += more;
    for (int v : mesh.faces[f]) middle_ += more / 3.0 * mesh.positions[v];
  }
  if (!(area > 0.0)) return;
  middle_ /= area;
  const Eigen::Matrix3d axes = principal_axes(mesh, middle_);
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  for (const Triangle& t : mesh.faces)
    for (int v : t) {
      const Vec3 p = axes.transpose() * (mesh.positions[v] - middle_);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  const Vec3 extent = high - low;
  if (!(extent.z() > kLongest * std::max(extent.x(), extent.y()))) return;
  axis_ = axes.col(2);
  std::vector<double> wanted;
  for (int f = 0; f < mesh.face_count(); ++f) {
    double along = 0.0, size = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = mesh.positions[mesh.faces[f][(k + 1) % 3]] - mesh.positions[mesh.faces[f][k]];
      along = std::max(along, std::abs(side.dot(axis_)));
      size = std::max(size, side.norm());
    }
    if (along > kFacingAxis * size) wanted.push_back(2.0 * face_area(mesh, f) / (along * along));
  }
  const auto median = wanted.begin() + wanted.size() / 2;
  std::nth_element(wanted.begin(), median, wanted.end());
  const double shortest = kLongest * std::max(extent.x(), extent.y()) / extent.z();
  factor_ = std::min(1.0, std::max(*median, shortest));
}

void Shortening::scale(Mesh& mesh, double factor) const {
  for (Vec3& p : mesh.positions) p += (factor - 1.0) * (p - middle_).dot(axis_) * axis_;
}

}  // namespace gsp
