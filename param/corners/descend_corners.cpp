#include "param/corners/descend_corners.h"

#include <cmath>

#include <Eigen/Dense>

namespace gsp {

namespace {

using Matrix = Eigen::Matrix2d;
using Vector = Eigen::Vector2d;

constexpr double kSteps[] = {0.3, 0.15, 0.075, 0.0375};  // of the rim, longest first
constexpr double kArmijo = 0.1;

Vector vector(Complex z) { return {z.real(), z.imag()}; }

Matrix columns(Complex a, Complex b) {
  Matrix m;
  m << a.real(), b.real(), a.imag(), b.imag();
  return m;
}

/// Energy of a map by area of the surface, J its derivative in units in which the surface is as large as the charts.
struct Density {
  Objective objective;

  /// `DistortionEnergy` at λ = 1 and ε = 0, or Dirichlet's.
  double value(const Matrix& j) const {
    if (objective == Objective::Linear) return 0.5 * j.squaredNorm();
    const double det = j.determinant();
    return det > 0.0 ? 0.5 * (j.squaredNorm() / det + det + 1.0 / det) : 1e300;
  }
  /// value(J) I - J^T dvalue/dJ: what the energy gains by area where the surface is drawn out under the map.
  Matrix stress(const Matrix& j) const {
    const Matrix metric = j.transpose() * j;
    if (objective == Objective::Linear) return 0.5 * j.squaredNorm() * Matrix::Identity() - metric;
    const double det = j.determinant();
    return ((j.squaredNorm() + 1.0) * Matrix::Identity() - metric) / det;
  }
};

/// One corner's disc and the energy of its faces.
class Descent {
 public:
  Descent(const CornerDisc& disc, Objective objective, double scale) : disc_(disc), density_{objective} {
    for (int f : disc.faces()) {
      const Triangle& t = disc.surface().mesh.faces[f];
      const Vec3 &p = disc.surface().mesh.positions[t[0]], &q = disc.surface().mesh.positions[t[1]],
                 &r = disc.surface().mesh.positions[t[2]];
      const double length = (q - p).norm(), along = (r - p).dot(q - p) / std::max(length, 1e-300);
      const double height = std::sqrt(std::max((r - p).squaredNorm() - along * along, 0.0));
      Matrix sides;
      sides << scale * length, scale * along, 0.0, scale * height;
      // Faces without area tell nothing.
      if (sides.determinant() > 1e-12 * sides.squaredNorm())
        faces_.push_back({f, 0.5 * sides.determinant(), sides.inverse()});
    }
  }

  double energy(const CornerDisc& disc, int center) const {
    double sum = 0.0;
    for (const Face& face : faces_)
      sum += face.area * density_.value(derivative(face, disc.in_plane(face.index, center)));
    return sum;
  }

  /// Of the energy, by where on the disc the corner goes.
  Complex gradient() const {
    const double rim = disc_.rim();
    Vector sum = Vector::Zero();
    for (const Face& face : faces_) {
      const Triangle& t = disc_.surface().mesh.faces[face.index];
      Complex w[3];
      double fade[3];
      for (int k = 0; k < 3; ++k) {
        const CornerDisc::Vertex& v = disc_.vertices()[disc_.index(t[k])];
        const double r = std::abs(v.disc) / rim;
        w[k] = v.disc;
        fade[k] = v.inside && r < 1.0 ? (1.0 - r * r) * (1.0 - r * r) : 0.0;
      }
      const Vector slope = face.inverse.transpose() * Vector(fade[1] - fade[0], fade[2] - fade[0]);
      const Matrix to_disc = columns(w[1] - w[0], w[2] - w[0]) * face.inverse;
      const Matrix stress = density_.stress(derivative(face, disc_.in_plane(face.index, 0)));
      sum += face.area * (to_disc.inverse().transpose() * (stress * slope));
    }
    return {sum.x(), sum.y()};
  }

 private:
  struct Face {
    int index;
    double area;     ///< in the units of the charts
    Matrix inverse;  ///< of its two sides in its plane
  };
  static Matrix derivative(const Face& face, const std::array<Complex, 3>& z) {
    return columns(z[1] - z[0], z[2] - z[0]) * face.inverse;
  }

  const CornerDisc& disc_;
  const Density density_;
  std::vector<Face> faces_;
};

bool descend(CornerDisc disc, Objective objective, double scale, CornerMove& move) {
  if (disc.fan().boundary || !disc.collect() || !disc.embedded()) return false;
  const Descent descent(disc, objective, scale);
  const Complex gradient = descent.gradient();
  const double before = descent.energy(disc, 0);
  if (!(std::abs(gradient) > 0.0) || !std::isfinite(before)) return false;
  int last = 0;
  for (double step : kSteps) {
    const int candidate = disc.nearest_to(-step * disc.rim() * gradient / std::abs(gradient));
    if (candidate == 0 || candidate == last) continue;
    last = candidate;
    const double slope = vector(gradient).dot(vector(disc.vertices()[candidate].disc));
    CornerDisc drawn = disc;
    if (slope >= 0.0 || !drawn.draw_to_center(candidate) || !drawn.embedded() || !drawn.upright_in_plane(candidate))
      continue;
    if (descent.energy(drawn, candidate) < before + kArmijo * slope && make_move(drawn, candidate, move)) return true;
    move = {};
  }
  return false;
}

}  // namespace

int descend_corners(Atlas& atlas, Objective objective, double radius, Folding folding) {
  const double scale = std::sqrt(atlas.base.face_count() * kChartArea / surface_area(atlas.surface->mesh));
  return move_corners(atlas, radius, folding, [&](CornerDisc disc, CornerMove& move) {
    return descend(std::move(disc), objective, scale, move);
  });
}

}  // namespace gsp
