#include "param/energy/distortion_energy.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>

#include "param/atlas/folds.h"

namespace gsp {

namespace {

constexpr double kLeastCurvature = 1e-4;           // of the largest, so that no direction is free
constexpr double kLargestShare = 4.0;              // of the area that a face stands for over its own
constexpr double kFlattestReference = 0.05;        // height over longest side of a reference triangle,
constexpr double kRound = 2.0 * std::numbers::pi;  // or as much less as the fans at its corners have no room for

/// The triangle laid into the plane, kept away from degenerate shapes, as large as what it stands for.
Eigen::Matrix2d reference_shape(const Surface& surface, int face, double mean_length) {
  const Mesh& mesh = surface.mesh;
  const Triangle& t = mesh.faces[face];
  const int fan = std::max({surface.fan_size[t[0]], surface.fan_size[t[1]], surface.fan_size[t[2]]});
  const double area = surface.face_area[face], flattest = std::min(kFlattestReference, kRound / fan);
  const Vec3 a = mesh.positions[t[1]] - mesh.positions[t[0]], b = mesh.positions[t[2]] - mesh.positions[t[0]];
  const double longest = std::max({a.norm(), b.norm(), (b - a).norm(), 1e-3 * mean_length, 1e-300});
  const double floor = flattest * longest;
  const double base = std::max(a.norm(), floor);
  Eigen::Matrix2d shape;
  const double along = a.norm() > 0.0 ? a.dot(b) / a.norm() : 0.0;
  const double height = a.norm() > 0.0 ? a.cross(b).norm() / a.norm() : b.norm();
  shape << base, along, 0.0, std::max(height, floor);
  const double larger = std::clamp(2.0 * area / shape.determinant(), 1.0, kLargestShare);
  return std::sqrt(larger) * shape;
}

/// z / |z|, and 1 for 0.
Complex direction_of(Complex z) {
  const double length = std::sqrt(std::norm(z));
  return length > 0.0 ? z / length : Complex(1.0);
}

/// One of the two square roots of a complex number of modulus 1.
Complex half_turn(Complex z) {
  return z.real() >= 0.0 ? direction_of({1.0 + z.real(), z.imag()}) : direction_of({z.imag(), 1.0 - z.real()});
}

/// An eigenvector of a face's Hessian by the four entries of J.
struct Mode {
  double curvature;
  Complex j1, j2;
};

/// With singular values s1, s2 and d = s1 s2, the energy of a face is f = (s1/s2 + s2/s1)/2 + λ (d + 1/d)/2. Its
/// Hessian has two eigenvectors in the plane of the stretches u1 v1ᵀ and u2 v2ᵀ, and the twist and the flip, (u2 v1ᵀ ∓
/// u1 v2ᵀ)/√2. The curvatures are those of the convex Hessian.
std::array<Mode, 4> convex_modes(Complex j1, Complex j2, double area_weight) {
  // J z = α z + β conj(z).
  const Complex i(0.0, 1.0), alpha = 0.5 * (j1 - i * j2), beta = 0.5 * (j1 + i * j2);
  const double a = std::sqrt(std::norm(alpha)), b = std::sqrt(std::norm(beta)), s1 = a + b, s2 = a - b;
  const double d = s1 * s2, q = s1 * s1 + s2 * s2, dd = d * d;
  const double half = 0.5 * area_weight;
  const double f11 = s2 / (s1 * s1 * s1) + area_weight / (s1 * s1 * d);
  const double f22 = s1 / (s2 * s2 * s2) + area_weight / (s2 * s2 * d);
  const double f12 = -0.5 * q / dd + half * (1.0 + 1.0 / dd);
  const double twist = 0.5 / d - 0.5 * (q - d) / dd + half * (1.0 - 1.0 / dd);
  const double flip = 0.5 / d + 0.5 * (q + d) / dd - half * (1.0 - 1.0 / dd);
  // u1 turns by half the sum of the arguments of α and β, v1 by half the difference of those of β and α.
  const Complex turn_of_alpha = direction_of(alpha);
  const Complex u = half_turn(turn_of_alpha * direction_of(beta)), v = u * std::conj(turn_of_alpha);
  const Complex stretch1[2] = {u * v.real(), u * v.imag()}, stretch2[2] = {-i * u * v.imag(), i * u * v.real()};
  const double mean = 0.5 * (f11 + f22), difference = 0.5 * (f11 - f22);
  const double radius = std::sqrt(difference * difference + f12 * f12);
  const Complex turn = half_turn(direction_of({difference, f12}));
  const double least = kLeastCurvature * (mean + radius), root = std::sqrt(0.5);
  const auto mode = [&](double curvature, double of_first, const Complex* first, double of_second,
                        const Complex* second) {
    return Mode{std::max(curvature, least), of_first * first[0] + of_second * second[0],
                of_first * first[1] + of_second * second[1]};
  };
  const Complex shear1[2] = {i * stretch1[0], i * stretch1[1]}, shear2[2] = {i * stretch2[0], i * stretch2[1]};
  return {mode(mean + radius, turn.real(), stretch1, turn.imag(), stretch2),
          mode(mean - radius, turn.real(), stretch2, -turn.imag(), stretch1), mode(twist, root, shear1, root, shear2),
          mode(flip, root, shear1, -root, shear2)};
}

}  // namespace

namespace {
constexpr double kLeastImage = 1e-12;  // area taken of faces whose images have none together

double image_area(const Atlas& atlas, int face) {
  const auto z = atlas.face_corners(face, atlas.face_frame(face));
  return chart_area(z[0], z[1], z[2]);
}
}  // namespace

std::vector<ReferenceShape> reference_shapes(const Atlas& atlas, const std::vector<int>& faces) {
  const Surface& surface = *atlas.surface;
  const Mesh& mesh = surface.mesh;
  double length = 0.0, chart = 0.0, area = 0.0;
  for (int f : faces)
    length += (mesh.positions[mesh.faces[f][1]] - mesh.positions[mesh.faces[f][0]]).norm() / faces.size();
  std::vector<ReferenceShape> shapes;
  shapes.reserve(faces.size());
  for (int f : faces) {
    const Eigen::Matrix2d shape = reference_shape(surface, f, length);
    const Eigen::Matrix2d inverse = shape.inverse();
    shapes.push_back({{inverse(0, 0), inverse(0, 1), inverse(1, 1)}, 0.5 * shape.determinant()});
    area += shapes.back().weight;
    chart += image_area(atlas, f);
  }
  const double scale = std::sqrt(std::max(chart, kLeastImage) / area);
  for (ReferenceShape& shape : shapes) {
    for (double& entry : shape.inverse) entry /= scale;
    shape.weight /= area;
  }
  return shapes;
}

std::vector<ReferenceShape> equilateral_shapes(const Atlas& atlas, const std::vector<int>& faces) {
  const double count = static_cast<double>(faces.size());
  double chart = 0.0;
  for (int f : faces) chart += image_area(atlas, f);
  const double side = std::sqrt(std::max(chart, kLeastImage) / count / kChartArea), height = std::sqrt(0.75) * side;
  return {faces.size(), {{1.0 / side, -0.5 / height, 1.0 / height}, 1.0 / count}};
}

DistortionEnergy::DistortionEnergy(const Atlas& atlas, const std::vector<int>& vertices, const std::vector<int>& faces,
                                   const std::vector<ReferenceShape>& shapes, double area_weight)
    : vertices_(vertices), area_weight_(area_weight) {
  assert(shapes.size() == faces.size() && area_weight > 0.0);
  assert(std::none_of(vertices.begin(), vertices.end(), [&](int v) { return atlas.corner[v] >= 0; }));
  std::vector<std::pair<int, int>> sorted;
  for (std::size_t i = 0; i < vertices_.size(); ++i) sorted.emplace_back(vertices_[i], static_cast<int>(i));
  std::sort(sorted.begin(), sorted.end());
  const auto variable = [&](int v) {
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), std::make_pair(v, 0));
    return at != sorted.end() && at->first == v ? at->second : -1;
  };
  const Mesh& mesh = atlas.surface->mesh;
  faces_.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Face face;
    face.shape = shapes[i];
    const Atlas::FaceFrame frame = atlas.face_frame(faces[i]);
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.faces[faces[i]][k];
      face.variable[k] = variable(v);
      face.turn[k] = omega_power(frame.to_chart[k].rotation);
      face.shift[k] = frame.to_chart[k].translation.value();
      face.held[k] = frame.to_chart[k].apply(atlas.position[v]);
    }
    faces_.push_back(face);
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
    least = std::min(least, 2.0 * chart_area(z[0], z[1], z[2]) * face.shape.inverse[0] * face.shape.inverse[2]);
  }
  return least;
}

bool DistortionEnergy::upright(const std::vector<double>& x) const {
  return std::all_of(faces_.begin(), faces_.end(), [&](const Face& face) {
    const auto z = corners(face, x.data());
    return gsp::upright(z[0], z[1], z[2]);
  });
}

DistortionEnergy::Columns DistortionEnergy::columns(const Face& face) {
  const double i00 = face.shape.inverse[0], i01 = face.shape.inverse[1], i11 = face.shape.inverse[2];
  return {{-i00, i00, 0.0}, {-i01 - i11, i01, i11}};
}

DistortionEnergy::Jacobian DistortionEnergy::jacobian(const Columns& by, const std::array<Complex, 3>& z) {
  const Complex e1 = z[1] - z[0], e2 = z[2] - z[0];
  return {by.first[1] * e1, by.second[1] * e1 + by.second[2] * e2};
}

DistortionEnergy::Slope DistortionEnergy::slope(const Jacobian& at, double epsilon) const {
  const auto& [j1, j2] = at;
  const double det = cross(j1, j2), square = std::norm(j1) + std::norm(j2);
  const double root = std::sqrt(epsilon * epsilon + det * det);
  const double chi = det > 0.0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
  const double shape = 0.5 * square / chi, area = 0.5 * area_weight_ * (det * det + 1.0) / chi;
  // dχ/d det = χ / root, and d det / dJ is the cofactor matrix (-i·j2, i·j1).
  const double by_det = area_weight_ * det / chi - (shape + area) / root;
  return {shape + area, j1 / chi + by_det * Complex(j2.imag(), -j2.real()),
          j2 / chi + by_det * Complex(-j1.imag(), j1.real())};
}

double DistortionEnergy::evaluate(const double* x, double* gradient, double epsilon) const {
  std::fill(gradient, gradient + 2 * vertices_.size(), 0.0);
  double energy = 0.0;
  for (const Face& face : faces_) {
    const Columns by = columns(face);
    const Slope at = slope(jacobian(by, corners(face, x)), epsilon);
    energy += face.shape.weight * at.density;
    for (int k = 0; k < 3; ++k) {
      if (face.variable[k] < 0) continue;
      const Complex g =
          face.shape.weight * std::conj(face.turn[k]) * (by.first[k] * at.by_j1 + by.second[k] * at.by_j2);
      gradient[2 * face.variable[k]] += g.real();
      gradient[2 * face.variable[k] + 1] += g.imag();
    }
  }
  // At ε = 0 a fold is infinitely far off, which a line search has to be told in a finite number.
  return std::isfinite(energy) ? energy : std::numeric_limits<double>::max();
}

double DistortionEnergy::density(int face, const double* x) const {
  const auto z = corners(faces_[face], x);
  if (!gsp::upright(z[0], z[1], z[2])) return std::numeric_limits<double>::infinity();
  return slope(jacobian(columns(faces_[face]), z), 0.0).density;
}

DistortionEnergy::ByCorner DistortionEnergy::by_corner(int face_index, int corner, const double* x) const {
  const Face& face = faces_[face_index];
  const Columns by = columns(face);
  const Jacobian at = jacobian(by, corners(face, x));
  const Slope s = slope(at, 0.0);
  const double first = by.first[corner], second = by.second[corner];
  const Complex g = face.shape.weight * std::conj(face.turn[corner]) * (first * s.by_j1 + second * s.by_j2);
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
  for (const Mode& mode : convex_modes(at.j1, at.j2, area_weight_)) {
    const Complex w = std::conj(face.turn[corner]) * (first * mode.j1 + second * mode.j2);
    const Eigen::Vector2d by_position(w.real(), w.imag());
    hessian += face.shape.weight * mode.curvature * by_position * by_position.transpose();
  }
  return {face.shape.weight * s.density, {g.real(), g.imag()}, hessian};
}

std::array<int, 3> DistortionEnergy::variables(int face) const {
  const Face& f = faces_[face];
  return {f.variable[0], f.variable[1], f.variable[2]};
}

Eigen::Matrix<double, 6, 6> DistortionEnergy::convex_hessian(int face_index, const double* x) const {
  const Face& face = faces_[face_index];
  const Columns by = columns(face);
  const Jacobian at = jacobian(by, corners(face, x));
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  for (const Mode& mode : convex_modes(at.j1, at.j2, area_weight_)) {
    double by_position[6];
    for (int k = 0; k < 3; ++k) {
      const Complex w = std::conj(face.turn[k]) * (by.first[k] * mode.j1 + by.second[k] * mode.j2);
      by_position[2 * k] = w.real();
      by_position[2 * k + 1] = w.imag();
    }
    const double weight = face.shape.weight * mode.curvature;
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column)
        hessian(column, row) += weight * by_position[row] * by_position[column];
  }
  return hessian;
}

double DistortionEnergy::longest_step(const double* x, const double* direction) const {
  double longest = 1.0;
  for (const Face& face : faces_) {
    const auto z = corners(face, x);
    Complex d[3];
    for (int k = 0; k < 3; ++k) {
      const int i = face.variable[k];
      d[k] = i < 0 ? Complex(0.0) : face.turn[k] * Complex(direction[2 * i], direction[2 * i + 1]);
    }
    // Twice the area along the way is c + b t + a t².
    const Complex e1 = z[1] - z[0], e2 = z[2] - z[0], d1 = d[1] - d[0], d2 = d[2] - d[0];
    const double a = cross(d1, d2), b = cross(e1, d2) + cross(d1, e2), c = cross(e1, e2);
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0) continue;
    // The smallest positive root, without cancellation.
    const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
    for (double root : {q / a, c / q})
      if (root > 0.0 && root < longest) longest = root;
  }
  return longest;
}

}  // namespace gsp
