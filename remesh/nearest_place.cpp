#include "remesh/nearest_place.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace gsp {

namespace {

/// The place of a walk so far and its squared distance.
struct Nearest {
  LevelPlace place;
  double squared = 0.0;
};

class Walk {
 public:
  Walk(const SubdivisionLevel& level, const std::vector<Vec3>& positions, const Vec3& point)
      : level_(level), positions_(positions), point_(point) {}

  Nearest in_face(int face) const {
    const Triangle& t = level_.faces[face];
    const std::array<const Vec3*, 3> corner = {&positions_[t[0]], &positions_[t[1]], &positions_[t[2]]};
    const Vec3 ab = *corner[1] - *corner[0], ac = *corner[2] - *corner[0], ap = point_ - *corner[0];
    const Vec3 normal = ab.cross(ac);
    const double squared_area = normal.squaredNorm();
    if (squared_area > 0.0) {
      const double wb = ap.cross(ac).dot(normal) / squared_area, wc = ab.cross(ap).dot(normal) / squared_area;
      const double wa = 1.0 - wb - wc;
      if (wa > 0.0 && wb > 0.0 && wc > 0.0) {
        const double height = ap.dot(normal);
        return {{face, {wa, wb, wc}}, height * height / squared_area};
      }
    }
    Nearest best = on_side(face, corner, 0);
    for (int k = 1; k < 3; ++k) {
      const Nearest side = on_side(face, corner, k);
      if (side.squared < best.squared) best = side;
    }
    return best;
  }

  /// The nearest among the faces that touch a place on the border of its face; the place itself where none is nearer.
  Nearest around(const Nearest& from) const {
    const std::array<double, 3>& w = from.place.weights;
    const int face = from.place.face;
    const auto corner = std::max_element(w.begin(), w.end()) - w.begin();
    if (w[corner] < 1.0) {
      const int k = w[2] == 0.0 ? 0 : w[0] == 0.0 ? 1 : 2;
      Nearest best = from;
      visit(level_.smooth_face(level_.face_edges[face][k], face), best);
      return best;
    }
    return around_vertex(from, level_.faces[face][corner]);
  }

 private:
  Nearest on_side(int face, const std::array<const Vec3*, 3>& corner, int k) const {
    const int next = (k + 1) % 3;
    const Vec3 side = *corner[next] - *corner[k];
    const double squared = side.squaredNorm();
    const double along = squared > 0.0 ? std::clamp((point_ - *corner[k]).dot(side) / squared, 0.0, 1.0) : 0.0;
    Nearest nearest;
    nearest.place.face = face;
    nearest.place.weights = {0.0, 0.0, 0.0};
    nearest.place.weights[k] = 1.0 - along;
    nearest.place.weights[next] = along;
    nearest.squared = (point_ - *corner[k] - along * side).squaredNorm();
    return nearest;
  }

  void visit(int face, Nearest& best) const {
    if (face < 0) return;
    const Nearest other = in_face(face);
    if (other.squared < best.squared) best = other;
  }

  Nearest around_vertex(const Nearest& from, int vertex) const {
    Nearest best = from;
    const int start = from.place.face;
    const std::array<int, 3>& sides = level_.face_edges[start];
    const int opposite = level_.faces[start][0] == vertex ? 1 : level_.faces[start][1] == vertex ? 2 : 0;
    // One way round and, where a sharp edge ends that, the other.
    for (int way = 1; way <= 2; ++way) {
      int face = start, edge = sides[(opposite + way) % 3];
      do {
        face = level_.smooth_face(edge, face);
        visit(face, best);
        if (face >= 0) edge = level_.other_side(face, edge, vertex);
      } while (face >= 0 && face != start);
      if (face == start) break;
    }
    return best;
  }

  const SubdivisionLevel& level_;
  const std::vector<Vec3>& positions_;
  const Vec3& point_;
};

}  // namespace

double walk_to_nearest(const SubdivisionLevel& level, const std::vector<Vec3>& positions, const Vec3& point,
                       LevelPlace& place) {
  const Walk walk(level, positions, point);
  Nearest nearest = walk.in_face(place.face);
  // A place that faces share starts from all of them, so that it does not matter in which it was given.
  if (!place.inside_face()) {
    const Nearest beside = walk.around({place, nearest.squared});
    if (beside.squared < nearest.squared) nearest = beside;
  }
  while (!nearest.place.inside_face()) {
    const Nearest next = walk.around(nearest);
    if (next.place.face == nearest.place.face) break;
    nearest = next;
  }
  place = nearest.place;
  return nearest.squared;
}

}  // namespace gsp
