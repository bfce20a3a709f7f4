#include "param/removal/vertex_map.h"

#include <algorithm>

#include "mesh/error.h"
#include "param/removal/flatten.h"

namespace gsp {

VertexMap::VertexMap(std::shared_ptr<const Surface> surface)
    : surface_(std::move(surface)),
      complex_(*surface_),
      locations_(surface_->mesh.positions.size()),
      points_(surface_->mesh.faces.size()) {}

void VertexMap::remove(const Removal& removal) {
  complex_.gather(removal.vertex, star_);
  flatten_star(surface_->mesh.positions, star_, ring_);
  moving_.assign(1, star_.center);
  moving_flat_.assign(1, 0.0);
  for (std::size_t k = 0; k < star_.triangles.size(); ++k) {
    const int slot = star_.triangles[k];
    for (int v : points_[slot]) {
      moving_.push_back(v);
      moving_flat_.push_back(flat_in_star(complex_, star_, ring_, static_cast<int>(k), locations_[v]));
    }
    points_[slot].clear();
  }
  complex_.replace(star_, removal.triangles, slots_);
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    int best_triangle = 0;
    std::array<double, 3> best{};
    double best_smallest = -1e300;
    for (std::size_t t = 0; t < removal.triangles.size(); ++t) {
      const RingTriangle& corners = removal.triangles[t];
      const auto w = barycentric(moving_flat_[i], ring_[corners[0]], ring_[corners[1]], ring_[corners[2]]);
      const double smallest = std::min({w[0], w[1], w[2]});
      if (smallest <= best_smallest) continue;
      best_smallest = smallest;
      best_triangle = static_cast<int>(t);
      best = w;
    }
    locations_[moving_[i]] = {slots_[best_triangle], best[1], best[2]};
    points_[slots_[best_triangle]].push_back(moving_[i]);
  }
}

}  // namespace gsp
