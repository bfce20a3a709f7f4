#include "param/simplify.h"

#include <algorithm>
#include <queue>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "param/automatic_stop.h"
#include "param/edge_paths.h"
#include "param/flatten.h"
#include "param/omega.h"
#include "param/triangle_complex.h"

namespace gsp {

namespace {

struct Entry {
  double cost;
  int vertex;
  int stamp;
  /// Least cost first, then the smaller vertex, so that the order is a function of the surface alone.
  bool operator<(const Entry& other) const {
    return cost != other.cost ? cost > other.cost : vertex > other.vertex;
  }
};

class Simplifier {
 public:
  Simplifier(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, Progress& progress)
      : surface_(std::move(surface)),
        options_(options),
        progress_(progress),
        complex_(*surface_),
        locations_(surface_->mesh.positions.size()),
        points_(surface_->mesh.faces.size()),
        paths_(*surface_, complex_.slot_count()),
        pricer_(*surface_, complex_, locations_, points_, options_) {}

  SimplifyResult run() {
    price_all();
    remove_until_done();
    return {make_atlas(), std::move(record_)};
  }

 private:
  void price_all();
  void remove_until_done();
  void remove(int vertex);
  void collect_moving();
  void relocate(const std::vector<RingTriangle>& triangles);
  Atlas make_atlas() const;

  std::shared_ptr<const Surface> surface_;
  const ParameterizeOptions& options_;
  Progress& progress_;
  TriangleComplex complex_;
  std::vector<Location> locations_;
  std::vector<std::vector<int>> points_;  ///< per triangle, the vertices inside it
  EdgePaths paths_;
  Pricer pricer_;
  Candidate candidate_;
  std::vector<int> slots_;
  std::vector<int> moving_;            ///< the vertices that a removal gives a new triangle,
  std::vector<Complex> moving_flat_;   ///< and where they lie in the flattened star
  std::vector<int> stamp_;
  std::vector<char> stale_;   ///< its star changed since it was priced
  std::vector<char> queued_;
  std::priority_queue<Entry> queue_;
  std::vector<OmegaRecord> record_;
  int remaining_ = 0;
};

void Simplifier::price_all() {
  const int count = surface_->mesh.vertex_count();
  std::vector<double> cost(count, -1.0);
  parallel_for(count, 2048, [&](std::size_t begin, std::size_t end) {
    Pricer pricer(*surface_, complex_, locations_, points_, options_);
    Candidate candidate;
    for (std::size_t v = begin; v < end; ++v) {
      if (surface_->halfedges.outgoing[v] < 0) continue;
      pricer.price(static_cast<int>(v), candidate);
      if (candidate.feasible) cost[v] = candidate.parts.omega();
    }
  });
  stamp_.assign(count, 0);
  stale_.assign(count, 0);
  queued_.assign(count, 0);
  for (int v = 0; v < count; ++v) {
    if (surface_->halfedges.outgoing[v] < 0) continue;
    ++remaining_;
    if (cost[v] < 0.0) continue;
    queue_.push({cost[v], v, 0});
    queued_[v] = 1;
  }
}

void Simplifier::remove_until_done() {
  const int start = remaining_;
  AutomaticStop stop(start);
  while (remaining_ > std::max(options_.base_vertices, 4) && !queue_.empty()) {
    const Entry top = queue_.top();
    queue_.pop();
    if (top.stamp != stamp_[top.vertex]) continue;
    if (stale_[top.vertex]) {
      stale_[top.vertex] = 0;
      queued_[top.vertex] = 0;
      pricer_.price(top.vertex, candidate_);
      if (!candidate_.feasible) continue;
      queue_.push({candidate_.parts.omega(), top.vertex, ++stamp_[top.vertex]});
      queued_[top.vertex] = 1;
      continue;
    }
    pricer_.price(top.vertex, candidate_);
    if (!candidate_.feasible) continue;
    candidate_.parts.remaining_vertices = remaining_ - 1;
    if (options_.base_vertices == 0 && stop.reached(candidate_.parts)) break;
    record_.push_back(candidate_.parts);
    remove(top.vertex);
    if (record_.size() % 4096 == 0)
      progress_.report("simplify", 1.0 - double(remaining_ - options_.base_vertices) / start);
  }
}

void Simplifier::remove(int vertex) {
  const Star star = pricer_.star();
  paths_.begin(star, points_);
  collect_moving();
  complex_.replace(star, candidate_.triangles, slots_);
  relocate(candidate_.triangles);
  paths_.finish(complex_, candidate_.triangles, slots_, locations_);
  --remaining_;
  queued_[vertex] = 0;
  for (int neighbour : star.ring) {
    stale_[neighbour] = 1;
    if (queued_[neighbour]) continue;
    // It could not be removed before; in its new star it may be.
    queue_.push({0.0, neighbour, ++stamp_[neighbour]});
    queued_[neighbour] = 1;
  }
}

void Simplifier::collect_moving() {
  const Star& star = pricer_.star();
  moving_.assign(1, star.center);
  moving_flat_.assign(1, 0.0);
  for (int slot : star.triangles) {
    for (int v : points_[slot]) {
      moving_.push_back(v);
      moving_flat_.push_back(pricer_.flat_position(v));
    }
    points_[slot].clear();
  }
}

void Simplifier::relocate(const std::vector<RingTriangle>& triangles) {
  const std::vector<Complex>& ring = pricer_.ring();
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    int best_triangle = 0;
    std::array<double, 3> best{};
    double best_smallest = -1e300;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto w = barycentric(moving_flat_[i], ring[triangles[t][0]], ring[triangles[t][1]], ring[triangles[t][2]]);
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

Atlas Simplifier::make_atlas() const {
  Atlas atlas;
  atlas.surface = surface_;
  const int count = surface_->mesh.vertex_count();
  atlas.corner.assign(count, -1);
  for (int v = 0; v < count; ++v) {
    if (surface_->halfedges.outgoing[v] < 0 || locations_[v].triangle >= 0) continue;
    atlas.corner[v] = atlas.base.vertex_count();
    atlas.base.vertices.push_back(v);
  }
  std::vector<int> face_of(complex_.slot_count(), -1);
  for (int t = 0; t < complex_.slot_count(); ++t) {
    if (!complex_.alive(t)) continue;
    face_of[t] = atlas.base.face_count();
    const Triangle& c = complex_.corners(t);
    atlas.base.faces.push_back({atlas.corner[c[0]], atlas.corner[c[1]], atlas.corner[c[2]]});
  }
  atlas.base.connect();
  atlas.fans = base_fans(atlas.base);
  atlas.patch.assign(count, -1);
  atlas.position.assign(count, 0.0);
  for (int v = 0; v < count; ++v) {
    if (surface_->halfedges.outgoing[v] < 0) continue;
    if (atlas.corner[v] >= 0) {
      const BaseFan::Sector& home = atlas.fans[atlas.corner[v]].sectors.front();
      atlas.patch[v] = home.face;
      atlas.position[v] = kChartCorners[home.corner].value();
    } else {
      const Location& at = locations_[v];
      atlas.patch[v] = face_of[at.triangle];
      atlas.position[v] = chart_position(1.0 - at.weight1 - at.weight2, at.weight1);
    }
  }
  // From a face around a corner to the corner's own chart.
  const auto to_home = [&](int v, int face) {
    if (atlas.corner[v] < 0) return Transition{};
    const BaseFan& fan = atlas.fans[atlas.corner[v]];
    return fan.develop(0).inverse() * fan.develop(fan.find(face));
  };
  atlas.transition.resize(surface_->edge_count());
  for (int e = 0; e < surface_->edge_count(); ++e) {
    const int h = surface_->edge_halfedge[e];
    const int start = surface_->halfedges.from(h), end = surface_->halfedges.to(h);
    const std::vector<int>& path = paths_.path(e);
    int first, last;
    Transition through;
    if (path.empty()) {
      if (atlas.corner[start] < 0) {
        first = atlas.patch[start];
      } else if (atlas.corner[end] < 0) {
        first = atlas.patch[end];
      } else {  // along a base edge: any face that has both corners
        first = -1;
        for (const BaseFan::Sector& s : atlas.fans[atlas.corner[start]].sectors)
          for (int k = 0; k < 3; ++k)
            if (atlas.base.faces[s.face][k] == atlas.corner[end]) first = s.face;
        if (first < 0) throw Error(Cause::Internal, "an edge between two corners is not classified", Element::Edge, e);
      }
      last = first;
    } else {
      first = face_of[path.front()];
      last = face_of[path.back()];
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const int k = complex_.edge_towards(path[i + 1], path[i]);
        through = through * atlas.base.across(3 * face_of[path[i + 1]] + k);
      }
    }
    atlas.transition[e] = to_home(start, first) * through * to_home(end, last).inverse();
  }
  return atlas;
}

}  // namespace

SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options,
                        Progress& progress) {
  return Simplifier(std::move(surface), options, progress).run();
}

}  // namespace gsp
