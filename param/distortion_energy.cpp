#include "param/distortion_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "param/folds.h"

namespace gsp {

namespace {

constexpr double kFlattestReference = 0.05;  // height over longest side of a reference triangle

/// The triangle laid into the plane, kept away from degenerate shapes.
Eigen::Matrix2d reference_shape(const Mesh& mesh, const Triangle& t, double mean_length) {
  const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
  const double longest = std::max({a.norm(), b.norm(), (b - a).norm(), 1e-3 * mean_length, 1e-300});
  const double floor = kFlattestReference * longest;
  const double base = std::max(a.norm(), floor);
  Eigen::Matrix2d shape;
  const double along = a.norm() > 0.0 ? a.dot(b) / a.norm() : 0.0;
  const double height = a.norm() > 0.0 ? a.cross(b).norm() / a.norm() : b.norm();
  shape << base, along, 0.0, std::max(height, floor);
  return shape;
}

}  // namespace

DistortionEnergy::DistortionEnergy(const Atlas& atlas, const std::vector<int>& vertices, const std::vector<int>& faces,
                                   double area_weight)
    : vertices_(vertices), area_weight_(area_weight) {
  std::vector<std::pair<int, int>> sorted;
  for (std::size_t i = 0; i < vertices_.size(); ++i) sorted.emplace_back(vertices_[i], static_cast<int>(i));
  std::sort(sorted.begin(), sorted.end());
  const auto variable = [&](int v) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(v, 0));
    return at != sorted.end() && at->first == v ? at->second : -1;
  };
  const Mesh& mesh = atlas.surface->mesh;
  double length = 0.0, chart = 0.0, area = 0.0;
  for (int f : faces)
    length += (mesh.positions[mesh.faces[f][1]] - mesh.positions[mesh.faces[f][0]]).norm() / faces.size();
  for (int f : faces) {
    Face face;
    const Atlas::FaceFrame frame = atlas.face_frame(f);
    for (int k = 0; k < 3; ++k) {
      face.variable[k] = variable(mesh.faces[f][k]);
      face.turn[k] = omega_power(frame.to_chart[k].rotation);
      face.shift[k] = frame.to_chart[k].translation.value();
      face.held[k] = frame.to_chart[k].apply(atlas.position[mesh.faces[f][k]]);
    }
    const Eigen::Matrix2d shape = reference_shape(mesh, mesh.faces[f], length);
    const Eigen::Matrix2d inverse = shape.inverse();
    face.inverse[0] = inverse(0, 0);
    face.inverse[1] = inverse(0, 1);
    face.inverse[2] = inverse(1, 1);
    face.weight = 0.5 * shape.determinant();
    area += face.weight;
    chart += chart_area(face.held[0], face.held[1], face.held[2]);
    faces_.push_back(face);
  }
  const double scale = std::sqrt(std::max(chart, 1e-12) / area);  // the reference as large as the image
  for (Face& face : faces_) {
    for (double& entry : face.inverse) entry /= scale;
    face.weight /= area;
  }
}

std::vector<double> DistortionEnergy::positions(const Atlas& atlas) const {
  std::vector<double> x;
  for (int v : vertices_) {
    x.push_back(atlas.position[v].real());
    x.push_back(atlas.position[v].imag());
  }
  return x;
}

void DistortionEnergy::write_back(const std::vector<double>& x, Atlas& atlas) const {
  for (std::size_t i = 0; i < vertices_.size(); ++i) atlas.position[vertices_[i]] = {x[2 * i], x[2 * i + 1]};
}

std::array<Complex, 3> DistortionEnergy::corners(const Face& face, const double* x) const {
  std::array<Complex, 3> z;
  for (int k = 0; k < 3; ++k) {
    const int i = face.variable[k];
    z[k] = i < 0 ? face.held[k] : face.turn[k] * Complex(x[2 * i], x[2 * i + 1]) + face.shift[k];
  }
  return z;
}

double DistortionEnergy::least_determinant(const std::vector<double>& x) const {
  double least = 1e300;
  for (const Face& face : faces_) {
    const auto z = corners(face, x.data());
    least = std::min(least, 2.0 * chart_area(z[0], z[1], z[2]) * face.inverse[0] * face.inverse[2]);
  }
  return least;
}

bool DistortionEnergy::upright(const std::vector<double>& x) const {
  return std::all_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    const auto z = corners(face, x.data());
    return gsp::upright(z[0], z[1], z[2]);
  });
}

double DistortionEnergy::evaluate(const double* x, double* gradient, double epsilon) const {
  std::fill(gradient, gradient + 2 * vertices_.size(), 0.0);
  double energy = 0.0;
  for (const Face& face : faces_) {
    const auto z = corners(face, x);
    const Complex e1 = z[1] - z[0], e2 = z[2] - z[0];
    const double i00 = face.inverse[0], i01 = face.inverse[1], i11 = face.inverse[2];
    const Complex j1 = i00 * e1, j2 = i01 * e1 + i11 * e2;  // the columns of J
    const double det = cross(j1, j2), square = std::norm(j1) + std::norm(j2);
    const double root = std::sqrt(epsilon * epsilon + det * det);
    const double chi = det > 0.0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
    const double shape = 0.5 * square / chi, area = 0.5 * area_weight_ * (det * det + 1.0) / chi;
    energy += face.weight * (shape + area);
    // dχ/d det = χ / root, and d det / dJ is the cofactor matrix (-i·j2, i·j1).
    const double by_det = area_weight_ * det / chi - (shape + area) / root;
    const Complex g1 = face.weight * (j1 / chi + by_det * Complex(j2.imag(), -j2.real()));
    const Complex g2 = face.weight * (j2 / chi + by_det * Complex(-j1.imag(), j1.real()));
    const Complex d1 = i00 * g1 + i01 * g2, d2 = i11 * g2;
    const Complex by_corner[3] = {-d1 - d2, d1, d2};
    for (int k = 0; k < 3; ++k) {
      if (face.variable[k] < 0) continue;
      const Complex g = std::conj(face.turn[k]) * by_corner[k];
      gradient[2 * face.variable[k]] += g.real();
      gradient[2 * face.variable[k] + 1] += g.imag();
    }
  }
  // At ε = 0 a fold is infinitely far off, which a line search has to be told in a finite number.
  return std::isfinite(energy) ? energy : std::numeric_limits<double>::max();
}

Eigen::SparseMatrix<Complex> DistortionEnergy::dirichlet_form() const {
  std::vector<Eigen::Triplet<Complex>> entries;
  entries.reserve(9 * faces_.size());
  for (const Face& face : faces_) {
    // Columns of J by corner: j1 = Σ a_k z_k, j2 = Σ b_k z_k.
    const double a[3] = {-face.inverse[0], face.inverse[0], 0.0};
    const double b[3] = {-face.inverse[1] - face.inverse[2], face.inverse[1], face.inverse[2]};
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        if (face.variable[k] >= 0 && face.variable[l] >= 0)
          entries.emplace_back(face.variable[k], face.variable[l],
                               face.weight * (a[k] * a[l] + b[k] * b[l]) * std::conj(face.turn[k]) * face.turn[l]);
  }
  const int n = static_cast<int>(vertices_.size());
  Eigen::SparseMatrix<Complex> form(n, n);
  form.setFromTriplets(entries.begin(), entries.end());
  return form;
}

}  // namespace gsp
