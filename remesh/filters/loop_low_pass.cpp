#include "remesh/filters/loop_low_pass.h"

#include <utility>
#include <vector>

#include "remesh/filters/cosine.h"

namespace gsp {

namespace {

class LoopLowPass : public TapFilter<LoopLowPass> {
 public:
  explicit LoopLowPass(const SubdivisionLevel& coarse) : TapFilter(coarse), fans_(vertex_fans(coarse)) {
    kept_.reserve(fans_.size());
    for (const VertexFan& fan : fans_) {
      const bool inside = fan.inside() && fan.valence > 0;
      kept_.push_back(fan.regular() ? 0.625 : inside ? loop_kept_weight(fan.valence) : fan.on_curve() ? 0.75 : 1.0);
    }
  }

  template <class Take>
  void for_each_tap(Take take) const {
    for (int v = 0; v < level_.vertex_count; ++v) take(v, v, kept_[v]);
    for (int e = 0; e < level_.edge_count(); ++e) edge_taps(e, take);
  }

 private:
  template <class Take>
  void edge_taps(int e, Take take) const {
    const auto [a, b] = level_.edges[e];
    const auto [left, right] = level_.edge_faces[e];
    const bool sharp = level_.sharp(e);
    for (const auto& [v, other] : {std::pair{a, b}, std::pair{b, a}}) {
      if (fans_[v].inside()) take(v, other, (1.0 - kept_[v]) / fans_[v].valence);
      if (fans_[v].on_curve() && sharp) take(v, other, 0.125);
    }
    for (int v : {a, b}) take(odd(e), v, sharp ? 0.5 : 0.375);
    if (sharp) return;
    for (int face : {left, right}) take(odd(e), level_.opposite_vertex(face, e), 0.125);
  }

  std::vector<VertexFan> fans_;
  std::vector<double> kept_;
};

}  // namespace

double loop_kept_weight(int valence) {
  const double c = 3.0 / 8.0 + cosine_of_turn(1, valence) / 4.0;
  return 3.0 / 8.0 + c * c;
}

std::unique_ptr<Filter> loop_low_pass(const SubdivisionLevel& coarse) { return std::make_unique<LoopLowPass>(coarse); }

}  // namespace gsp
