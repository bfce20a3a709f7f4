#include "remesh/filters/butterfly_update.h"

#include <vector>

namespace gsp {

namespace {

class Update : public TapFilter<Update> {
 public:
  explicit Update(const SubdivisionLevel& coarse) : TapFilter(coarse), faces_(coarse.vertex_count, 0) {
    for (const Triangle& t : coarse.faces)
      for (int v : t) ++faces_[v];
  }
  template <class Take>
  void for_each_tap(Take take) const {
    for (int e = 0; e < level_.edge_count(); ++e) {
      const int around = level_.edge_faces[e][1] < 0 ? 3 : 6;
      for (int v : level_.edges[e]) take(v, e, around / (8.0 * faces_[v]));
    }
  }

 private:
  std::vector<int> faces_;
};

}  // namespace

std::unique_ptr<Filter> butterfly_update(const SubdivisionLevel& coarse) { return std::make_unique<Update>(coarse); }

}  // namespace gsp
