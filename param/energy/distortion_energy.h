#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "param/atlas/atlas.h"

namespace gsp {

/// λ of `DistortionEnergy` for maps: areas count as much as angles.
inline constexpr double kMapAreaWeight = 1.0;

/// A face's shape on the surface, of which its image should be a copy.
struct ReferenceShape {
  double inverse[3];  ///< of the upper triangular matrix of its edges in the plane: (0,0), (0,1), (1,1)
  double weight;      ///< share of the area
};

/// The shapes of some faces, kept away from degenerate ones, together as large as their images in the map. #faces.
/// O(faces).
std::vector<ReferenceShape> reference_shapes(const Atlas& atlas, const std::vector<int>& faces);

/// The same equilateral shape for each, together as large as their images in the map. #faces. O(faces).
std::vector<ReferenceShape> equilateral_shapes(const Atlas& atlas, const std::vector<int>& faces);

/// The energy of Garanzha et al. 2021 over some faces of a map: Σ A (|J|²/(2χ) + λ (det² + 1)/(2χ)), J the affine map
/// from the surface's triangle (its `ReferenceShape`) to its image, A its share of the area, χ(ε) = (det + √(ε² +
/// det²))/2. The first term is least for similarities, the second for equal areas. With ε = 0 it is finite for upright
/// faces only; with larger ε it is finite for all and drives folds apart. Variables are the positions of some vertices
/// in their charts, two doubles each; all other vertices are held.
class DistortionEnergy {
 public:
  /// `vertices`: distinct, not patch corners. `faces` should be all that touch them. `area_weight`: λ > 0.
  /// `shapes`: per face of `faces`.
  DistortionEnergy(const Atlas& atlas, const std::vector<int>& vertices, const std::vector<int>& faces,
                   const std::vector<ReferenceShape>& shapes, double area_weight);

  /// The vertices' present positions.
  std::vector<double> positions(const Atlas& atlas) const;
  void write_back(const std::vector<double>& x, Atlas& atlas) const;

  /// Energy and gradient at x for ε.
  double evaluate(const double* x, double* gradient, double epsilon) const;
  /// Energy of one face by area, with ε = 0: 1 + λ for an isometry, infinite where the face is not upright.
  double density(int face, const double* x) const;
  double weight(int face) const { return faces_[face].shape.weight; }
  double least_determinant(const std::vector<double>& x) const;
  bool upright(const std::vector<double>& x) const;

  int face_count() const { return static_cast<int>(faces_.size()); }
  int variable_count() const { return static_cast<int>(vertices_.size()); }
  /// The vertices of a face as indices into `vertices`, -1 where held.
  std::array<int, 3> variables(int face) const;
  /// Second derivatives of one upright face's energy with ε = 0 by its corners' positions (x, y each), with the
  /// negative eigenvalues of those by J, which are known in closed form (Smith et al. 2019), left out. Rows of held
  /// corners too.
  Eigen::Matrix<double, 6, 6> convex_hessian(int face, const double* x) const;

  /// The energy of one upright face with ε = 0 and its derivatives by the position of one corner, which is not held.
  struct ByCorner {
    double energy;
    Eigen::Vector2d gradient;
    Eigen::Matrix2d convex_hessian;
  };
  ByCorner by_corner(int face, int corner, const double* x) const;

  /// The largest t <= 1 for which no face loses its area on the way from x to x + s·direction, s < t.
  double longest_step(const double* x, const double* direction) const;

 private:
  struct Face {
    int variable[3];            ///< -1 where held
    Complex turn[3], shift[3];  ///< from the vertex's chart to the face's
    Complex held[3];
    ReferenceShape shape;
  };

  /// Columns of J by corner: j1 = Σ first[k] z_k, j2 = Σ second[k] z_k.
  struct Columns {
    double first[3], second[3];
  };
  static Columns columns(const Face& face);
  std::array<Complex, 3> corners(const Face& face, const double* x) const;
  struct Jacobian {
    Complex j1, j2;
  };
  static Jacobian jacobian(const Columns& by, const std::array<Complex, 3>& z);
  /// Energy of a face by area, and its slope by the columns of J.
  struct Slope {
    double density;
    Complex by_j1, by_j2;
  };
  Slope slope(const Jacobian& at, double epsilon) const;

  std::vector<int> vertices_;
  std::vector<Face> faces_;
  double area_weight_;
};

}  // namespace gsp
