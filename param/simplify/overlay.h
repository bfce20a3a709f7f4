#pragma once

#include <memory>
#include <vector>

#include "param/atlas/atlas.h"
#include "param/refined/coarsen.h"
#include "param/refined/refined_surface.h"
#include "param/removal/location.h"
#include "param/removal/triangle_complex.h"
#include "param/simplify/planar_region.h"

namespace gsp {

/// The surface's map onto the shrinking complex T^i of §3.1 as a homeomorphism, not just for its vertices: the surface
/// is cut along the edges of the complex, so each of its pieces lies in one triangle and is mapped affinely, upright. A
/// removal lays the star's pieces into the plane, where they are embedded since its ring is star-shaped about the
/// vertex, and cuts them along the new edges; vertices that older cuts have added are taken out again where the map
/// stays upright without. The paper, as MAPS before it, carries the vertices only, and faces fold where their edges are
/// drawn straight.
class OverlayMap {
 public:
  /// Whether a removal may leave far more pieces than the surface has vertices there. A simplification refuses it, and
  /// takes another one: around a small handle edges of the complex could come to wind about it, once more each time.
  enum class Winding { Refused, Allowed };

  explicit OverlayMap(std::shared_ptr<const Surface> surface, Winding winding = Winding::Refused);

  /// Fills the hole of the removed vertex. False, and nothing is changed, where a piece of the star would be too small
  /// for rounding, or where the edges of the complex would wind and must not.
  bool remove(const Removal& removal) { return remove(std::vector<Removal>{removal}); }
  /// All of several whose stars have no triangle in common, or none.
  bool remove(const std::vector<Removal>& removals);

  const std::shared_ptr<const Surface>& surface() const { return surface_; }
  const TriangleComplex& complex() const { return complex_; }
  /// The map onto the present complex. The surface's own vertices come first, then those that cuts have added. O(V).
  Atlas atlas() const { return atlas_on(refined_->compact()); }

  const RefinedSurface& refined() const { return *refined_; }

  /// The same without the added vertices that the map does not need (`gsp::coarsen`).
  EditableAtlas coarsened() const;

 private:
  /// Where a vertex lies on the complex: in a triangle, on an edge between two of its vertices, or at one.
  struct Place {
    int triangle = -1;
    int a = -1, b = -1;
    double weight1 = 0.0, weight2 = 0.0;  ///< of the triangle's corners 1 and 2; on an edge weight1 is that of b
  };
  static bool on_side(const Place& at, int a, int b);
  static Complex home_position(const Atlas& atlas, int v, const Place& at);
  static Transition to_home(const Atlas& atlas, int v, int chart, const Place& at);
  Complex flat_of(int v) const;

  Atlas atlas_on(const RefinedSurface::Compact& compact) const;

  struct Backup {
    RefinedSurface::Snapshot refined;
    Star star;
    std::vector<int> vertices;             ///< of the region
    std::vector<Place> place;              ///< of each
    std::vector<std::vector<int>> pieces;  ///< per triangle of the star
  };
  Backup lay_out(int vertex);
  void take_back(const Backup& backup);
  void leave();
  bool cut_star(const Removal& removal);
  bool cut_all(const Removal& removal);
  bool winds() const;
  void straighten_boundary();
  bool fill(int slot, const RingTriangle& triangle);

  std::shared_ptr<const Surface> surface_;
  const Winding winding_;
  TriangleComplex complex_;
  std::unique_ptr<RefinedSurface> refined_;  ///< where it is known to `region_`
  PlanarRegion region_;
  std::vector<Place> place_;              ///< per vertex
  std::vector<std::vector<int>> pieces_;  ///< per triangle of the complex, the faces in it

  // Of the removal in hand.
  Star star_;
  std::vector<Complex> ring_;
  std::vector<int> slots_;
  std::vector<int> ring_index_;  ///< per vertex of the surface
  std::vector<int> star_index_;  ///< per triangle
  std::vector<char> filled_;     ///< per face
};

}  // namespace gsp
