#pragma once

#include <optional>

#include "remesh/normal/chart_index.h"
#include "remesh/normal/remesh_domain.h"

namespace gsp {

struct Line {
  Vec3 point;
  Vec3 direction;  ///< unit

  Vec3 nearest(const Vec3& p) const { return point + direction * direction.dot(p - point); }
};

/// Where a line meets a triangle from behind: the weights of its corners, which are not negative and sum to 1; nothing
/// where it misses or meets it from the front. A line through an edge meets one of two triangles that share it, or
/// both: no line slips through.
std::optional<std::array<double, 3>> pierce(const Line& line, const std::array<Vec3, 3>& corners);

/// A point of the surface on a line, for the vertex that an edge inserts.
struct Hit {
  DomainVertex place;
  Vec3 position;  ///< on the line, and on the surface up to rounding
};

/// Where a part of the domain lies in the charts, face by face of a level.
class FaceReach {
 public:
  /// O(F).
  explicit FaceReach(const RemeshDomain& domain);
  const FacePiece* begin(int face) const { return pieces_.data() + begin_[face]; }
  const FacePiece* end(int face) const { return pieces_.data() + begin_[face + 1]; }

 private:
  std::vector<std::size_t> begin_;
  std::vector<FacePiece> pieces_;
};

/// Of the points where `line` leaves the surface through its front, over the faces of `edge`: the one whose place in
/// the domain is nearest to `expected`, in the chart of the edge's first face, and not farther than `aperture`.
std::optional<Hit> nearest_hit(const ChartIndex& index, const RemeshDomain& domain, const FaceReach& reach, int edge,
                               const Line& line, Complex expected, double aperture);

/// The surface's own point over a place on an edge, given like `expected`.
Hit surface_hit(const ChartIndex& index, const RemeshDomain& domain, const FaceReach& reach, int edge, Complex place);

}  // namespace gsp
