#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "coder/bit_model.h"
#include "remesh/semiregular.h"

namespace gsp {

/// Which edges inside a base are creases, one decision an edge. Creases are curves: where one is found it is followed
/// on both sides, and at each of its vertices the edge that goes straight on is asked for first. `Side` is an end of
/// the stream: `decide(actual, context)` writes or reads a bit. O(E) memory; O(sum of valences).
template <class Side>
class CreaseCoder {
 public:
  CreaseCoder(const SubdivisionLevel& base, Side& side)
      : base_(base),
        side_(side),
        told_(base.edges.size(), 0),
        found_(base.edges.size(), 0),
        degree_(base.vertex_count) {
    // A curve of its own starts at few edges, and goes on at about every vertex, mostly straight on.
    constexpr double kStart = 0.05, kOn[kRanks] = {0.6, 0.4, 0.4, 0.4, 0.4, 0.4};
    start_ = expecting(kStart);
    for (int rank = 0; rank < kRanks; ++rank) {
      on_[0][rank] = expecting(kOn[rank]);
      on_[1][rank] = on_[2][rank] = expecting(kStart);
    }
  }

  /// #E, of which `actual` are those of the encoder; nothing is read from it to decode.
  std::vector<char> run(const std::vector<char>& actual) {
    for (int e = 0; e < base_.edge_count(); ++e) {
      tell(e, actual, start_);
      while (!ends_.empty()) {
        const auto [edge, vertex] = ends_.back();
        ends_.pop_back();
        follow(edge, vertex, actual);
      }
    }
    return std::move(found_);
  }

 private:
  static constexpr int kRanks = 6, kDegrees = 3;

  void tell(int e, const std::vector<char>& actual, AdaptiveBit& context) {
    if (std::exchange(told_[e], 1) || base_.on_boundary(e)) return;
    found_[e] = side_.decide(!actual.empty() && actual[e], context);
    if (!found_[e]) return;
    for (int v : base_.edges[e]) {
      ++degree_[v];
      ends_.push_back({e, v});
    }
  }

  /// The other edges at the end `v` of the crease `e`.
  void follow(int e, int v, const std::vector<char>& actual) {
    around(e, v);
    int rank = 0;
    for (int edge : ring_) {
      if (told_[edge]) continue;
      tell(edge, actual, on_[std::min(degree_[v], kDegrees) - 1][std::min(rank++, kRanks - 1)]);
    }
  }

  /// Fills `ring_` with the edges that the faces join to `e` around `v`, straight on first.
  void around(int e, int v) {
    ring_.clear();
    int face = base_.edge_faces[e][0], edge = e;
    const auto walk = [&] {
      while (face >= 0) {
        edge = base_.other_side(face, edge, v);
        if (edge == e) return true;
        ring_.push_back(edge);
        face = base_.other_face(edge, face);
      }
      return false;
    };
    if (!walk()) {
      std::reverse(ring_.begin(), ring_.end());
      face = base_.edge_faces[e][1], edge = e;
      walk();
    }
    const int last = static_cast<int>(ring_.size()) - 1;
    std::vector<std::pair<int, int>> order;
    for (int i = 0; i <= last; ++i) order.push_back({std::abs(2 * i - last), ring_[i]});
    std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (int i = 0; i <= last; ++i) ring_[i] = order[i].second;
  }

  const SubdivisionLevel& base_;
  Side& side_;
  std::vector<char> told_, found_;
  std::vector<int> degree_;                ///< #V, creases found there
  std::vector<std::pair<int, int>> ends_;  ///< of creases, to follow: edge and vertex
  std::vector<int> ring_;
  AdaptiveBit start_;
  std::array<std::array<AdaptiveBit, kRanks>, kDegrees> on_;
};

}  // namespace gsp
