#include "remesh/filters/loop_limit.h"

#include <cmath>
#include <utility>

#include "mesh/fixed_order.h"
#include "remesh/filters/cosine.h"
#include "remesh/filters/loop_low_pass.h"

namespace gsp {

namespace {

class LimitPoints : public TapFilter<LimitPoints> {
 public:
  explicit LimitPoints(const SubdivisionLevel& level) : TapFilter(level), fans_(vertex_fans(level)) {
    neighbour_.reserve(fans_.size());
    for (const VertexFan& fan : fans_) {
      const bool inside = fan.inside() && fan.valence > 0;
      neighbour_.push_back(fan.regular() ? 1.0 / 12 : inside ? inside_weight(fan.valence) : 0.0);
    }
  }

  template <class Take>
  void for_each_tap(Take take) const {
    for (int v = 0; v < level_.vertex_count; ++v)
      take(v, v, fans_[v].on_curve() ? 2.0 / 3 : 1.0 - fans_[v].valence * neighbour_[v]);
    for (int e = 0; e < level_.edge_count(); ++e) {
      const auto [a, b] = level_.edges[e];
      const bool sharp = level_.sharp(e);
      for (const auto& [v, other] : {std::pair{a, b}, std::pair{b, a}}) {
        if (fans_[v].inside()) take(v, other, neighbour_[v]);
        if (fans_[v].on_curve() && sharp) take(v, other, 1.0 / 6);
      }
    }
  }

 private:
  /// Of the left eigenvector to the eigenvalue 1.
  static double inside_weight(int valence) {
    return 1.0 / (valence + 3.0 * valence / (8.0 * (1.0 - loop_kept_weight(valence))));
  }

  std::vector<VertexFan> fans_;
  std::vector<double> neighbour_;  ///< weight of each neighbour of a vertex inside
};

/// The vertices around one, counter-clockwise; on a boundary from its one end to the other.
class Rings {
 public:
  explicit Rings(const SubdivisionLevel& level) : level_(level), start_(level.vertex_count, -1) {
    for (int f = 0; f < level.face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int v = level.faces[f][k];
        const bool first_of_boundary = level.edge_faces[level.face_edges[f][k]][1] < 0;
        if (start_[v] < 0 || first_of_boundary) start_[v] = 3 * f + k;
      }
  }

  /// Whether the ring is closed.
  bool around(int v, std::vector<int>& ring) const {
    ring.clear();
    if (start_[v] < 0) return false;
    const int first_face = start_[v] / 3;
    int face = first_face, edge = level_.face_edges[face][start_[v] % 3];
    do {
      ring.push_back(level_.other_end(edge, v));
      edge = level_.other_side(face, edge, v);
      face = level_.other_face(edge, face);
    } while (face >= 0 && face != first_face);
    if (face < 0) ring.push_back(level_.other_end(edge, v));
    return face >= 0;
  }

 private:
  const SubdivisionLevel& level_;
  std::vector<int> start_;  ///< #V, three times a face plus the corner that is the vertex, -1 for none
};

/// Of a closed fan: first harmonics of the ring.
Vec3 inside_normal(const std::vector<int>& ring, const std::vector<Vec3>& positions) {
  Vec3 cosines = Vec3::Zero(), sines = Vec3::Zero();
  const int k = static_cast<int>(ring.size());
  for (int j = 0; j < k; ++j) {
    const Vec3& p = positions[ring[j]];
    const double c = cosine_of_turn(j, k), s = cosine_of_turn(((4 * j - k) % (4 * k) + 4 * k) % (4 * k), 4 * k);
    for (int x = 0; x < 3; ++x) {
      cosines[x] += c * p[x];
      sines[x] += s * p[x];
    }
  }
  return cross(cosines, sines);
}

/// Of an open fan: along the boundary, and across it by the left eigenvector that is symmetric along the ring. Its
/// weights of the edges inside are sin(iθ), θ half a turn over the faces, with the eigenvalue 3/8 + cos(θ)/4; those of
/// the ends and of the vertex itself solve the two equations that are left.
Vec3 boundary_normal(int v, const std::vector<int>& ring, const std::vector<Vec3>& positions) {
  const int k = static_cast<int>(ring.size());
  double at_vertex = -2.0, at_end = 1.0;
  Vec3 inwards = Vec3::Zero();
  const auto add = [&](int vertex, double weight) {
    for (int x = 0; x < 3; ++x) inwards[x] += weight * positions[vertex][x];
  };
  if (k > 2) {
    const auto sine = [&](int i) { return cosine_of_turn(std::abs(2 * i - (k - 1)), 4 * (k - 1)); };
    const double eigenvalue = 3.0 / 8 + cosine_of_turn(1, 2 * (k - 1)) / 4;
    double sum = 0.0;
    for (int i = 1; i + 1 < k; ++i) {
      sum += sine(i);
      add(ring[i], sine(i));
    }
    at_end = (3.0 / 8 * sum + (eigenvalue - 0.75) * sine(1)) / (8.0 * (eigenvalue - 0.75) * (eigenvalue - 0.5) - 1.0);
    at_vertex = 8.0 * (eigenvalue - 0.5) * at_end - sine(1);
  }
  add(ring.front(), at_end);
  add(ring.back(), at_end);
  add(v, at_vertex);
  return cross(positions[ring.front()] - positions[ring.back()], inwards);
}

Vec3 face_normals(int v, const std::vector<int>& ring, bool closed, const std::vector<Vec3>& positions) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t j = 0; j + (closed ? 0 : 1) < ring.size(); ++j) {
    const Vec3 a = positions[ring[j]] - positions[v], b = positions[ring[(j + 1) % ring.size()]] - positions[v];
    sum += cross(a, b);
  }
  return sum;
}

}  // namespace

std::unique_ptr<Filter> loop_limit_points(const SubdivisionLevel& level) {
  return std::make_unique<LimitPoints>(level);
}

std::vector<Vec3> loop_limit_normals(const SubdivisionLevel& level, const std::vector<Vec3>& positions) {
  const Rings rings(level);
  std::vector<Vec3> normals(level.vertex_count, Vec3::UnitZ());
  std::vector<int> ring;
  for (int v = 0; v < level.vertex_count; ++v) {
    const bool closed = rings.around(v, ring);
    if (ring.size() < 2) continue;
    const Vec3 tangents = closed ? inside_normal(ring, positions) : boundary_normal(v, ring, positions);
    if (const auto n = unit(tangents))
      normals[v] = *n;
    else if (const auto mean = unit(face_normals(v, ring, closed, positions)))
      normals[v] = *mean;
  }
  return normals;
}

std::vector<Vec3> loop_limit_conormals(const SubdivisionLevel& level, const std::vector<Vec3>& positions,
                                       const std::vector<Vec3>& normals) {
  // The spline's tangent is along the chord between the vertices on both sides: each boundary edge, which runs with the
  // surface on its left, gives a half of it.
  std::vector<Vec3> chords(level.vertex_count, Vec3::Zero());
  std::vector<int> boundary_edges(level.vertex_count, 0);
  for (int e = 0; e < level.edge_count(); ++e) {
    if (level.edge_faces[e][1] >= 0) continue;
    const auto [a, b] = level.edges[e];
    const Vec3 along = positions[b] - positions[a];
    for (int v : {a, b}) {
      chords[v] += along;
      ++boundary_edges[v];
    }
  }
  std::vector<Vec3> conormals(level.vertex_count, Vec3::Zero());
  for (int v = 0; v < level.vertex_count; ++v) {
    if (boundary_edges[v] != 2) continue;
    if (const auto outward = unit(cross(chords[v], normals[v]))) conormals[v] = *outward;
  }
  return conormals;
}

}  // namespace gsp
