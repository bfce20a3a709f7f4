#include "coder/butterfly_filters.h"

#include <cmath>
#include <vector>

namespace gsp {

namespace {

class LowPass : public Filter {
 public:
  explicit LowPass(const SubdivisionLevel& coarse) : Filter(coarse), fans_(vertex_fans(coarse)) {}

  void vertex_taps(int v, std::vector<Tap>& out) const override { out.push_back({v, v, 1.0}); }

  void edge_taps(int e, std::vector<Tap>& out) const override {
    const auto [a, b] = level_.edges[e];
    if (level_.edge_faces[e][1] < 0) return boundary_stencil(e, out);
    if (!irregular(a) && !irregular(b)) return regular_stencil(e, out);
    const double share = irregular(a) && irregular(b) ? 0.5 : 1.0;
    if (irregular(a)) irregular_stencil(e, a, share, out);
    if (irregular(b)) irregular_stencil(e, b, share, out);
  }

 private:
  bool irregular(int v) const { return fans_[v].boundary_count == 0 && fans_[v].valence != 6 && fans_[v].valence >= 3; }

  void regular_stencil(int e, std::vector<Tap>& out) const {
    const auto [a, b] = level_.edges[e];
    for (int v : {a, b}) out.push_back({odd(e), v, 0.5});
    for (int face : level_.edge_faces[e]) {
      const int opposite = level_.opposite_vertex(face, e);
      out.push_back({odd(e), opposite, 0.125});
      for (const auto& [corner, far] : {std::pair{a, b}, std::pair{b, a}}) {
        const int side = level_.other_side(face, e, corner), beyond = level_.other_face(side, face);
        if (beyond >= 0) {
          out.push_back({odd(e), level_.opposite_vertex(beyond, side), -1.0 / 16});
        } else {
          out.push_back({odd(e), corner, -1.0 / 16});
          out.push_back({odd(e), opposite, -1.0 / 16});
          out.push_back({odd(e), far, 1.0 / 16});
        }
      }
    }
  }

  /// The rule around the irregular vertex `centre`, which is the same in both directions around it.
  void irregular_stencil(int e, int centre, double share, std::vector<Tap>& out) const {
    const int k = fans_[centre].valence;
    out.push_back({odd(e), centre, 0.75 * share});
    int edge = e, face = level_.edge_faces[e][0];
    for (int j = 0; j < k; ++j) {
      out.push_back({odd(e), level_.other_end(edge, centre), share * neighbour_weight(k, j)});
      if (face < 0) break;
      edge = level_.other_side(face, edge, centre);
      face = level_.other_face(edge, face);
    }
  }

  static double neighbour_weight(int k, int j) {
    if (k == 3) return j == 0 ? 5.0 / 12 : -1.0 / 12;
    if (k == 4) return j == 0 ? 3.0 / 8 : j == 2 ? -1.0 / 8 : 0.0;
    const double angle = 2.0 * M_PI * j / k;
    return (0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / k;
  }

  void boundary_stencil(int e, std::vector<Tap>& out) const {
    const auto [a, b] = level_.edges[e];
    for (const auto& [near, far] : {std::pair{a, b}, std::pair{b, a}}) {
      out.push_back({odd(e), near, 9.0 / 16});
      const std::array<int, 2>& boundary = fans_[near].boundary_edges;
      const int next = boundary[boundary[0] == e];
      if (next >= 0) {
        out.push_back({odd(e), level_.other_end(next, near), -1.0 / 16});
      } else {
        out.push_back({odd(e), near, -2.0 / 16});
        out.push_back({odd(e), far, 1.0 / 16});
      }
    }
  }

  std::vector<VertexFan> fans_;
};

class Update : public Filter {
 public:
  explicit Update(const SubdivisionLevel& coarse) : Filter(coarse), faces_(coarse.vertex_count, 0) {
    for (const Triangle& t : coarse.faces)
      for (int v : t) ++faces_[v];
  }
  void vertex_taps(int, std::vector<Tap>&) const override {}
  void edge_taps(int e, std::vector<Tap>& out) const override {
    const int around = level_.edge_faces[e][1] < 0 ? 3 : 6;
    for (int v : level_.edges[e]) out.push_back({v, e, around / (8.0 * faces_[v])});
  }

 private:
  std::vector<int> faces_;
};

}  // namespace

std::unique_ptr<Filter> butterfly_low_pass(const SubdivisionLevel& coarse) { return std::make_unique<LowPass>(coarse); }
std::unique_ptr<Filter> butterfly_update(const SubdivisionLevel& coarse) { return std::make_unique<Update>(coarse); }

}  // namespace gsp
