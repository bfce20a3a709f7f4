#include "remesh/filters/butterfly_update.h"

#include <vector>

namespace gsp {

namespace {

class Update : public TapFilter<Update> {
 public:
  explicit Update(const SubdivisionLevel& coarse)
      : TapFilter(coarse), fans_(vertex_fans(coarse)), faces_(coarse.vertex_count, 0) {
    for (const Triangle& t : coarse.faces)
      for (int v : t) ++faces_[v];
  }
  template <class Take>
  void for_each_tap(Take take) const {
    for (int e = 0; e < level_.edge_count(); ++e) {
      const int around = level_.on_boundary(e) ? 3 : 6;
      for (int v : level_.edges[e]) {
        if (!level_.creased[e] && !fans_[v].on_crease())
          take(v, e, around / (8.0 * faces_[v]));
        else if (level_.creased[e] && fans_[v].on_curve())
          take(v, e, 0.25);
      }
    }
  }

 private:
  std::vector<VertexFan> fans_;
  std::vector<int> faces_;
};

}  // namespace

std::unique_ptr<Filter> butterfly_update(const SubdivisionLevel& coarse) { return std::make_unique<Update>(coarse); }

}  // namespace gsp
