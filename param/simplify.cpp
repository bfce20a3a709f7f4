#include "param/simplify.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "param/automatic_stop.h"
#include "param/omega.h"
#include "param/shrinking_map.h"

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

constexpr int kRatio = 8;             // vertices of one level for each of the next
constexpr int kSmallestLevel = 4000;
constexpr int kLevelPerBase = 8;      // vertices of the coarsest level but the base for each of the base

/// What all levels share.
struct Run {
  const ParameterizeOptions& options;
  Progress& progress;
  AutomaticStop stop;
  SimplifyResult result;
  int start;       ///< vertices of the finest surface
  bool ended = false;
};

/// Removes vertices of one level.
class Simplifier {
 public:
  /// `finest`: per vertex of the surface, its number in the finest one. `target`: vertices to stop at. `last`: the complex
  /// that remains will be the base.
  Simplifier(std::shared_ptr<const Surface> surface, const std::vector<int>& finest, int target, bool last, Run& run)
      : surface_(surface),
        finest_(finest),
        target_(target),
        run_(run),
        map_(surface, false),
        overlay_(surface),
        pricer_(*surface_, map_.complex(), map_.locations(), map_.points(), run_.options, last) {}

  OverlayMap run() {
    price_all();
    remove_until_done();
    return std::move(overlay_);
  }

 private:
  void price_all();
  void remove_until_done();
  bool remove(int vertex);

  std::shared_ptr<const Surface> surface_;
  const std::vector<int>& finest_;
  const int target_;
  Run& run_;
  ShrinkingMap map_;
  OverlayMap overlay_;
  Pricer pricer_;
  Candidate candidate_;
  std::vector<int> stamp_;
  std::vector<char> stale_;   ///< its star changed since it was priced
  std::vector<char> queued_;
  std::priority_queue<Entry> queue_;
  std::vector<Triangle> filling_;
  int remaining_ = 0;
};

void Simplifier::price_all() {
  const int count = surface_->mesh.vertex_count();
  std::vector<double> cost(count, -1.0);
  parallel_for(count, 2048, [&](std::size_t begin, std::size_t end) {
    Pricer pricer = pricer_;
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
  std::vector<OmegaRecord>& record = run_.result.omega;
  while (remaining_ > target_ && !queue_.empty()) {
    const Entry top = queue_.top();
    queue_.pop();
    if (top.stamp != stamp_[top.vertex]) continue;
    queued_[top.vertex] = 0;  // if it cannot be removed now it waits until its star changes
    pricer_.price(top.vertex, candidate_);
    if (!candidate_.feasible) continue;
    if (stale_[top.vertex]) {
      stale_[top.vertex] = 0;
      queued_[top.vertex] = 1;
      queue_.push({candidate_.parts.omega(), top.vertex, ++stamp_[top.vertex]});
      continue;
    }
    candidate_.parts.remaining_vertices = remaining_ - 1;
    if (run_.options.base_vertices == 0 && run_.stop.reached(candidate_.parts)) {
      record.push_back(candidate_.parts);
      run_.ended = true;
      return;
    }
    if (!remove(top.vertex)) continue;
    record.push_back(candidate_.parts);
    if (record.size() % 4096 == 0)
      run_.progress.report("simplify", double(record.size()) / (run_.start - run_.options.base_vertices));
  }
}

bool Simplifier::remove(int vertex) {
  const Removal removal{vertex, candidate_.triangles};
  if (!overlay_.remove(removal)) return false;
  map_.remove(removal);
  const std::vector<int>& ring = pricer_.star().ring;
  filling_.clear();
  for (const RingTriangle& t : candidate_.triangles)
    filling_.push_back({finest_[ring[t[0]]], finest_[ring[t[1]]], finest_[ring[t[2]]]});
  run_.result.removals.add(finest_[vertex], filling_);
  --remaining_;
  for (int neighbour : ring) {
    stale_[neighbour] = 1;
    if (queued_[neighbour]) continue;
    // It could not be removed before; in its new star it may be.
    queue_.push({0.0, neighbour, ++stamp_[neighbour]});
    queued_[neighbour] = 1;
  }
  return true;
}

int used_vertices(const Surface& surface) {
  return static_cast<int>(std::count_if(surface.halfedges.outgoing.begin(), surface.halfedges.outgoing.end(), [](int h) { return h >= 0; }));
}

}  // namespace

void RemovalScript::add(int vertex, const std::vector<Triangle>& triangles) {
  vertices_.push_back(vertex);
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  first_.push_back(static_cast<int>(triangles_.size()));
}

void RemovalScript::place(int removal, const Star& star, Removal& made) const {
  made.vertex = vertices_[removal];
  made.triangles.clear();
  for (int i = first_[removal]; i < first_[removal + 1]; ++i) {
    RingTriangle t;
    for (int k = 0; k < 3; ++k)
      t[k] = static_cast<int>(std::find(star.ring.begin(), star.ring.end(), triangles_[i][k]) - star.ring.begin());
    std::sort(t.begin(), t.end());
    made.triangles.push_back(t);
  }
}

SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, int most_levels,
                        Progress& progress) {
  const int start = used_vertices(*surface);
  Run run{options, progress, AutomaticStop(start), {}, start};
  const int base = std::max(options.base_vertices, 4);
  std::vector<int> finest(surface->mesh.positions.size());
  std::iota(finest.begin(), finest.end(), 0);
  for (bool stuck = false;;) {
    const int count = used_vertices(*surface);
    const int next = std::max({count / kRatio, kSmallestLevel, kLevelPerBase * base});
    const bool last = static_cast<int>(run.result.levels.size()) + 1 >= most_levels || stuck || 2 * next > count;
    run.result.levels.push_back(Simplifier(surface, finest, last ? base : next, last, run).run());
    if (last || run.ended) return std::move(run.result);
    CoarseSurface coarse = coarse_surface(run.result.levels.back());
    stuck = 2 * static_cast<int>(coarse.vertex.size()) > count;
    for (int& v : coarse.vertex) v = finest[v];
    finest = std::move(coarse.vertex);
    surface = std::move(coarse.surface);
  }
}

std::vector<int> remaining_vertices(const Surface& surface, const RemovalScript& removals) {
  std::vector<char> removed(surface.mesh.positions.size(), 0);
  for (int i = 0; i < removals.size(); ++i) removed[removals.vertex(i)] = 1;
  std::vector<int> remaining;
  for (std::size_t v = 0; v < removed.size(); ++v)
    if (!removed[v] && surface.halfedges.outgoing[v] >= 0) remaining.push_back(static_cast<int>(v));
  return remaining;
}

Atlas maps_of(const SimplifyResult& simplified) {
  ShrinkingMap map(simplified.levels.front().surface(), true);
  Star star;
  Removal removal;
  for (int i = 0; i < simplified.removals.size(); ++i) {
    map.complex().gather(simplified.removals.vertex(i), star);
    simplified.removals.place(i, star, removal);
    map.remove(removal);
  }
  return map.atlas();
}

}  // namespace gsp
