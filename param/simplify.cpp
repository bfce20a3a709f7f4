#include "param/simplify.h"

#include <algorithm>
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

class Simplifier {
 public:
  Simplifier(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, Progress& progress)
      : surface_(std::move(surface)),
        options_(options),
        progress_(progress),
        map_(surface_),
        overlay_(surface_),
        pricer_(*surface_, map_.complex(), map_.locations(), map_.points(), options_) {}

  SimplifyResult run() {
    price_all();
    remove_until_done();
    return {map_.atlas(), std::move(overlay_), std::move(record_)};
  }

 private:
  void price_all();
  void remove_until_done();
  bool remove(int vertex);

  std::shared_ptr<const Surface> surface_;
  const ParameterizeOptions& options_;
  Progress& progress_;
  ShrinkingMap map_;
  OverlayMap overlay_;
  Pricer pricer_;
  Candidate candidate_;
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
    Pricer pricer(*surface_, map_.complex(), map_.locations(), map_.points(), options_);
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
    queued_[top.vertex] = 0;  // if it cannot be removed now it waits until its star changes
    pricer_.price(top.vertex, candidate_);
    if (!candidate_.feasible) continue;
    candidate_.parts.remaining_vertices = remaining_ - 1;
    if (options_.base_vertices == 0 && stop.reached(candidate_.parts)) {
      record_.push_back(candidate_.parts);
      break;
    }
    if (!remove(top.vertex)) continue;
    record_.push_back(candidate_.parts);
    if (record_.size() % 4096 == 0)
      progress_.report("simplify", 1.0 - double(remaining_ - options_.base_vertices) / start);
  }
}

bool Simplifier::remove(int vertex) {
  const Removal removal{vertex, candidate_.triangles};
  if (!overlay_.remove(removal)) return false;
  map_.remove(removal);
  --remaining_;
  for (int neighbour : pricer_.star().ring) {
    stale_[neighbour] = 1;
    if (queued_[neighbour]) continue;
    // It could not be removed before; in its new star it may be.
    queue_.push({0.0, neighbour, ++stamp_[neighbour]});
    queued_[neighbour] = 1;
  }
  return true;
}

}  // namespace

SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options,
                        Progress& progress) {
  return Simplifier(std::move(surface), options, progress).run();
}

}  // namespace gsp
