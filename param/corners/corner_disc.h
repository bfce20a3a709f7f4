#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>
#include <vector>

#include "param/atlas/atlas.h"
#include "param/linear/weights.h"

namespace gsp {

inline constexpr double kSectorAngle = std::numbers::pi / 3.0;

/// The surface around one patch corner on a disc, where the k patches are k equal sectors (§3.2.2): radius r and angle
/// φ in the plane developed about the corner go to r^(6/k) and φ·6/k. Around a boundary corner it is a half disc, by
/// 3/k.
class CornerDisc {
 public:
  struct Vertex {
    int vertex;
    bool inside;         ///< may move; the others form the held rim
    Transition develop;  ///< its chart -> the plane developed about the corner
    double angle;        ///< in that plane, continued without jumps from the first vertex (in (-∞, ∞))
    Complex disc;        ///< position in the disc
  };

  /// `radius` in base edges. The atlas must outlive the disc and stay as it is.
  CornerDisc(const Atlas& atlas, double radius, int base_vertex);

  /// Lays out the vertices within the radius that are connected to the corner, and their rim. False where they are no
  /// disc.
  bool collect();
  /// Puts the inside where the weights want it, the corner free and the rim held. False where it could not be solved.
  bool solve(const LinearWeights& weights);
  /// Whether every face that touches the inside is upright in the disc.
  bool embedded() const;
  /// The vertex nearest a place of those inside that may become the corner, as an index into `vertices`; 0 where there
  /// is none.
  int nearest_to(Complex place) const;
  /// Moves the disc's middle so that a vertex lies at 0: a shift that fades out smoothly toward the rim. False, and
  /// nothing is changed, where the vertex is too near the rim.
  bool draw_to_center(int index);
  /// Distance of the rim from 0.
  double rim() const;
  /// The three corners of a face that touches the inside in the plane developed about the corner, turned so that the
  /// first one that is not `center` lies on the real axis; `center` lies at 0.
  std::array<Complex, 3> in_plane(int face, int center) const;
  /// The faces that touch the inside, ascending.
  std::vector<int> faces() const;
  /// Whether every face that touches the inside has positive area once the disc is taken back to the charts by z^(k/6),
  /// the vertex `center` being the corner.
  bool upright_in_plane(int center) const;

  const Atlas& atlas() const { return atlas_; }
  const Surface& surface() const { return *atlas_.surface; }
  const BaseFan& fan() const { return fan_; }
  int corner() const { return corner_; }                             ///< vertex of the surface
  double power() const { return power_; }                            ///< of the map to the disc
  const std::vector<Vertex>& vertices() const { return vertices_; }  ///< [0] is the corner
  int index(int vertex) const { return index_.at(vertex); }

 private:
  void gather();
  bool lift();
  void straighten_border();
  Complex to_disc(double radius, double angle) const { return std::polar(std::pow(radius, power_), angle * power_); }

  const Atlas& atlas_;
  const double radius_;
  const BaseFan& fan_;
  const int corner_;
  const double power_;
  std::vector<Vertex> vertices_;
  std::unordered_map<int, int> index_;
};

}  // namespace gsp
