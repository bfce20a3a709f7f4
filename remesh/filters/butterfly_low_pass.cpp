#include "remesh/filters/butterfly_low_pass.h"

#include <utility>
#include <vector>

#include "remesh/filters/cosine.h"

namespace gsp {

namespace {

class ButterflyLowPass : public TapFilter<ButterflyLowPass> {
 public:
  explicit ButterflyLowPass(const SubdivisionLevel& coarse) : TapFilter(coarse), fans_(vertex_fans(coarse)) {
    for (int v = 0; v < coarse.vertex_count; ++v)
      if (irregular(v)) set_weights(fans_[v].valence);
  }

  template <class Take>
  void for_each_tap(Take take) const {
    for (int v = 0; v < level_.vertex_count; ++v) take(v, v, 1.0);
    for (int e = 0; e < level_.edge_count(); ++e) {
      const auto [a, b] = level_.edges[e];
      const bool a_irregular = irregular(a), b_irregular = irregular(b);
      if (level_.sharp(e)) {
        curve_stencil(e, take);
      } else if (!a_irregular && !b_irregular) {
        regular_stencil(e, take);
      } else {
        const double share = a_irregular && b_irregular ? 0.5 : 1.0;
        if (a_irregular) irregular_stencil(e, a, share, take);
        if (b_irregular) irregular_stencil(e, b, share, take);
      }
    }
  }

 private:
  bool irregular(int v) const { return fans_[v].sharp_count == 0 && fans_[v].valence != 6 && fans_[v].valence >= 3; }

  template <class Take>
  void regular_stencil(int e, Take take) const {
    const auto [a, b] = level_.edges[e];
    for (int v : {a, b}) take(odd(e), v, 0.5);
    for (int face : level_.edge_faces[e]) {
      const int opposite = level_.opposite_vertex(face, e);
      take(odd(e), opposite, 0.125);
      for (const auto& [corner, far] : {std::pair{a, b}, std::pair{b, a}}) {
        const int side = level_.other_side(face, e, corner), beyond = level_.smooth_face(side, face);
        if (beyond >= 0) {
          take(odd(e), level_.opposite_vertex(beyond, side), -1.0 / 16);
        } else {
          take(odd(e), corner, -1.0 / 16);
          take(odd(e), opposite, -1.0 / 16);
          take(odd(e), far, 1.0 / 16);
        }
      }
    }
  }

  /// The rule around the irregular vertex `centre`, which is the same in both directions around it.
  template <class Take>
  void irregular_stencil(int e, int centre, double share, Take take) const {
    const int k = fans_[centre].valence;
    take(odd(e), centre, 0.75 * share);
    int edge = e, face = level_.edge_faces[e][0];
    for (int j = 0; j < k; ++j) {
      take(odd(e), level_.other_end(edge, centre), share * weights_[k][j]);
      if (face < 0) break;
      edge = level_.other_side(face, edge, centre);
      face = level_.other_face(edge, face);
    }
  }

  void set_weights(int k) {
    if (static_cast<int>(weights_.size()) <= k) weights_.resize(k + 1);
    if (!weights_[k].empty()) return;
    for (int j = 0; j < k; ++j) weights_[k].push_back(neighbour_weight(k, j));
  }

  static double neighbour_weight(int k, int j) {
    if (k == 3) return j == 0 ? 5.0 / 12 : -1.0 / 12;
    if (k == 4) return j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0.0;
    return (0.25 + cosine_of_turn(j, k) + 0.5 * cosine_of_turn(2 * j % k, k)) / k;
  }

  template <class Take>
  void curve_stencil(int e, Take take) const {
    const auto [a, b] = level_.edges[e];
    for (const auto& [near, far] : {std::pair{a, b}, std::pair{b, a}}) {
      take(odd(e), near, 9.0 / 16);
      const int next = fans_[near].beyond(e);
      if (next >= 0) {
        take(odd(e), level_.other_end(next, near), -1.0 / 16);
      } else {
        take(odd(e), near, -2.0 / 16);
        take(odd(e), far, 1.0 / 16);
      }
    }
  }

  std::vector<VertexFan> fans_;
  std::vector<std::vector<double>> weights_;  ///< of the neighbours of an irregular vertex, by its valence
};

}  // namespace

std::unique_ptr<Filter> butterfly_low_pass(const SubdivisionLevel& coarse) {
  return std::make_unique<ButterflyLowPass>(coarse);
}

}  // namespace gsp
