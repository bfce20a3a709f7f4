#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "param/atlas.h"

namespace gsp {

/// The energy of Garanzha et al. 2021 over some faces of a map: Σ A (|J|²/(2χ) + λ (det² + 1)/(2χ)), J the affine map from
/// the surface's triangle (its shape kept away from degenerate ones, its size as in the whole set of faces) to its image, A
/// its share of the area, χ(ε) = (det + √(ε² + det²))/2. The first term is least for similarities, the second for equal
/// areas. With ε = 0 it is finite for upright faces only; with larger ε it is finite for all and drives folds apart.
/// Variables are the positions of some vertices in their charts, two doubles each; all other vertices are held.
class DistortionEnergy {
 public:
  /// `vertices`: distinct, not patch corners. `faces` should be all that touch them. `area_weight`: λ > 0.
  DistortionEnergy(const Atlas& atlas, const std::vector<int>& vertices, const std::vector<int>& faces,
                   double area_weight);

  /// The vertices' present positions.
  std::vector<double> positions(const Atlas& atlas) const;
  void write_back(const std::vector<double>& x, Atlas& atlas) const;

  /// Energy and gradient at x for ε.
  double evaluate(const double* x, double* gradient, double epsilon) const;
  double least_determinant(const std::vector<double>& x) const;
  bool upright(const std::vector<double>& x) const;

  /// Σ A |J|² / 2 as a Hermitian form of the variables, positive definite where something is held: to precondition with.
  Eigen::SparseMatrix<Complex> dirichlet_form() const;

 private:
  struct Face {
    int variable[3];          ///< -1 where held
    Complex turn[3], shift[3];  ///< from the vertex's chart to the face's
    Complex held[3];
    double inverse[3];        ///< of the reference's upper triangular edge matrix: (0,0), (0,1), (1,1)
    double weight;
  };

  std::array<Complex, 3> corners(const Face& face, const double* x) const;

  std::vector<int> vertices_;
  std::vector<Face> faces_;
  double area_weight_;
};

}  // namespace gsp
