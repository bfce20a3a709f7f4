#include "param/simplify/simplify.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <queue>
#include <utility>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "param/removal/removal_cost.h"
#include "param/removal/vertex_map.h"
#include "param/simplify/automatic_stop.h"
#include "param/simplify/removal_order.h"

namespace gsp {

namespace {

struct Entry {
  double cost;
  int vertex;
  int stamp;
  /// Least cost first, then the smaller vertex, so that the order is a function of the surface alone.
  bool operator<(const Entry& other) const { return cost != other.cost ? cost > other.cost : vertex > other.vertex; }
};

constexpr int kRatio = 8;            // most vertices of one level for each of the next
constexpr int kAutomaticRatio = 16;  // vertices for each of the coarsest level, where the base's size is not known
constexpr int kSmallestLevel = 1000;
constexpr int kBatchShare = 64;  // vertices of the complex for each of those that are priced side by side
constexpr int kBlocks = 8, kLargestBlock = 16;  // of such a batch
constexpr double kCopyShare =
    0.5;  // of the Ω of a vertex with two copies: the mean of the two sides (bench/README.md, "Feature curves")
constexpr int kLevelPerBase = 24;  // vertices of the coarsest level for each of the base

/// Copies of one counted once.
int used_vertices(const Surface& surface) { return surface.seams.count_whole(remaining_vertices(surface, {})); }

class Simplifier {
 public:
  Simplifier(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, Progress& progress)
      : surface_(surface),
        options_(options),
        progress_(progress),
        neighbours_(*surface),
        map_(surface),
        start_(used_vertices(*surface)),
        stop_(start_),
        remaining_(start_),
        pricers_(kBlocks,
                 RemovalCost(*surface_, neighbours_, map_.complex(), map_.locations(), map_.points(), options_)) {
    if (options.priority == Priority::Maps) maps_.emplace(map_.complex(), surface_->mesh.positions, options.replicate);
  }

  SimplifyResult run(int coarsest);

 private:
  /// Numbers of the present level's surface.
  struct Level {
    std::shared_ptr<const Surface> surface;
    std::vector<int> vertex;  ///< per vertex of the finest surface
    std::vector<int> face;    ///< per triangle of the complex
  };

  const Seams& seams() const { return surface_->seams; }
  /// The vertex by which it is queued: of two copies the first.
  int key(int vertex) const {
    const int other = seams().other_of(vertex);
    return other >= 0 && other < vertex ? other : vertex;
  }
  OmegaRecord parts(int vertex) const;
  double price(int vertex) const;
  void price_with_copy(RemovalCost& pricer, int vertex);
  bool fit(int vertex, int other) const;
  void begin_round();
  void price_all();
  void price_next(int vertex);
  void remove_down_to(int target);
  bool gather(int vertex);
  bool remove();
  void take_out(const Star& star, const Candidate& candidate);
  bool has_taken_edge(const Star& star, const Candidate& candidate) const;
  Star of_level(const Star& star) const;
  Removal in_overlay(const Star& star, const std::vector<RingTriangle>& triangles) const;
  void end_level();

  std::shared_ptr<const Surface> surface_;
  const ParameterizeOptions& options_;
  Progress& progress_;
  const NeighbourLists neighbours_;
  VertexMap map_;
  const int start_;  ///< vertices of the surface
  AutomaticStop stop_;
  std::optional<MapsOrder> maps_;  ///< in place of Ω
  int remaining_;
  bool ended_ = false;  ///< by the automatic stop
  SimplifyResult result_;
  Level level_;
  RemovalRecord decimation_;  ///< of the present level, but for the last one

  std::vector<Candidate> candidates_;  ///< per vertex, as it was last priced
  std::vector<int> stamp_;
  std::vector<char> stale_;  ///< its star, or a triangle behind it, has changed since it was priced
  std::vector<char> queued_;
  std::priority_queue<Entry> queue_;
  std::vector<RemovalCost> pricers_;  ///< of the blocks of a batch
  std::vector<int> batch_;
  std::vector<Entry> fresh_;
  std::vector<Triangle> filling_;
  std::vector<Star> stars_;  ///< of the removal in hand, one for each copy of its vertex
};

/// What the removal of a vertex with all its copies does.
OmegaRecord Simplifier::parts(int vertex) const {
  OmegaRecord sum = candidates_[vertex].parts;
  if (const int other = seams().other_of(vertex); other >= 0) {
    const OmegaRecord& more = candidates_[other].parts;
    sum.shape += more.shape;
    sum.dispersion += more.dispersion;
    sum.metric += more.metric;
  }
  return sum;
}

/// What the removal costs, by which vertices are queued: its Ω, but for a replicate's chance, or MAPS' priority.
double Simplifier::price(int vertex) const {
  if (maps_) return maps_->price(vertex);
  const double omega = (seams().other_of(vertex) < 0 ? 1.0 : kCopyShare) * parts(vertex).omega();
  return omega * factor_of_chance(options_.replicate, vertex);
}

/// MAPS weighs what is left, and all that can be removed is queued anew.
void Simplifier::begin_round() {
  std::vector<int> left;
  for (int v = 0; v < static_cast<int>(surface_->mesh.positions.size()); ++v)
    if (key(v) == v && map_.complex().has(v)) left.push_back(v);
  maps_->begin_round(left);
  queue_ = {};
  for (int v : left)
    if (queued_[v]) queue_.push({price(v), v, ++stamp_[v]});
}

/// Whether the fillings of two copies' holes have no edge in common on the whole surface, but for that along the curve.
bool Simplifier::fit(int vertex, int other) const {
  Star here, there;
  map_.complex().gather(vertex, here);
  map_.complex().gather(other, there);
  const auto is_closing = [](const Star& star, const RingTriangle& t) { return t[0] == 0 && t[2] == star.size() - 1; };
  for (const RingTriangle& t : candidates_[vertex].triangles)
    for (const RingTriangle& u : candidates_[other].triangles) {
      if (is_closing(here, t) || is_closing(there, u)) continue;
      const int a = here.ring[t[0]], b = here.ring[t[2]], c = there.ring[u[0]], d = there.ring[u[2]];
      if ((seams().same(a, c) && seams().same(b, d)) || (seams().same(a, d) && seams().same(b, c))) return false;
    }
  return true;
}

/// Prices a vertex, and with it its other copy, which goes with it or stays with it.
void Simplifier::price_with_copy(RemovalCost& pricer, int vertex) {
  pricer.price(vertex, candidates_[vertex]);
  const int other = seams().other_of(vertex);
  if (other < 0 || !candidates_[vertex].feasible) return;
  pricer.price(other, candidates_[other]);
  candidates_[vertex].feasible = candidates_[other].feasible && fit(vertex, other);
}

void Simplifier::price_all() {
  const auto step = progress_.step("price all vertices");
  const int count = surface_->mesh.vertex_count();
  candidates_.resize(count);
  parallel_for(count, 2048, [&](std::size_t begin, std::size_t end) {
    RemovalCost pricer = pricers_.front();
    for (std::size_t v = begin; v < end; ++v)
      if (surface_->halfedges.outgoing[v] >= 0 && key(static_cast<int>(v)) == static_cast<int>(v))
        price_with_copy(pricer, static_cast<int>(v));
  });
  stamp_.assign(count, 0);
  stale_.assign(count, 0);
  queued_.assign(count, 0);
  for (int v = 0; v < count; ++v) queued_[v] = key(v) == v && candidates_[v].feasible;
  if (maps_) return begin_round();
  for (int v = 0; v < count; ++v)
    if (queued_[v]) queue_.push({price(v), v, 0});
}

/// Whether an edge of the filling has come to join two vertices of the ring elsewhere since it was chosen.
bool Simplifier::has_taken_edge(const Star& star, const Candidate& candidate) const {
  return std::any_of(candidate.triangles.begin(), candidate.triangles.end(), [&](const RingTriangle& t) {
    const bool closing = t[0] == 0 && t[2] == star.size() - 1;  // an edge of the ring, but for a star on a boundary
    return (!closing || star.boundary) && map_.complex().edge_exists(star.ring[t[0]], star.ring[t[2]]);
  });
}

/// Prices a vertex, and with it those that are to be priced next, on all cores. How many depends on the complex alone,
/// and is small beside it, so that few of them change again before their turn.
void Simplifier::price_next(int vertex) {
  batch_.assign(1, vertex);
  fresh_.clear();
  const std::size_t most = std::clamp(remaining_ / kBatchShare, 1, kBlocks * kLargestBlock);
  while (batch_.size() < most && fresh_.size() < most && !queue_.empty()) {
    const Entry next = queue_.top();
    queue_.pop();
    if (next.stamp != stamp_[next.vertex]) continue;
    if (stale_[next.vertex])
      batch_.push_back(next.vertex);
    else
      fresh_.push_back(next);
  }
  for (const Entry& entry : fresh_) queue_.push(entry);
  const std::size_t block = (batch_.size() + kBlocks - 1) / kBlocks;
  parallel_for(batch_.size(), block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) price_with_copy(pricers_[begin / block], batch_[i]);
  });
  for (int v : batch_) {
    stale_[v] = 0;
    queued_[v] = candidates_[v].feasible;
    ++stamp_[v];
    if (queued_[v]) queue_.push({price(v), v, stamp_[v]});
  }
}

void Simplifier::remove_down_to(int target) {
  std::vector<OmegaRecord>& record = result_.omega;
  bool round_removes = true;  // a round that does not is the last
  while (!ended_ && remaining_ > target && !queue_.empty()) {
    const Entry top = queue_.top();
    if (maps_ && !maps_->is_due(top.cost)) {
      if (!std::exchange(round_removes, false)) return;
      begin_round();
      continue;
    }
    queue_.pop();
    if (top.stamp != stamp_[top.vertex]) continue;
    if (stale_[top.vertex] || !gather(top.vertex)) {
      price_next(top.vertex);
      continue;
    }
    queued_[top.vertex] = 0;  // if it cannot be removed now it waits until its star changes
    if (!std::all_of(stars_.begin(), stars_.end(), [&](const Star& s) { return pricers_.front().leaves_surface(s); }))
      continue;
    OmegaRecord next = parts(top.vertex);
    next.remaining_vertices = remaining_ - 1;
    if (options_.base_vertices == kBaseByOmega && stop_.reached(next)) {
      record.push_back(next);
      ended_ = true;
      return;
    }
    if (!remove()) continue;
    round_removes = true;
    record.push_back(next);
    if (record.size() % 4096 == 0)
      progress_.report("simplify", double(record.size()) / (start_ - options_.base_vertices));
  }
}

/// A star by the numbers of the level's surface.
Star Simplifier::of_level(const Star& star) const {
  Star there = star;
  there.center = level_.vertex[star.center];
  for (int& v : there.ring) v = level_.vertex[v];
  for (int& t : there.triangles) t = level_.face[t];
  return there;
}

/// The same removal by the overlay's complex, which may start its ring elsewhere.
Removal Simplifier::in_overlay(const Star& star, const std::vector<RingTriangle>& triangles) const {
  Star there;
  result_.map->complex().gather(level_.vertex[star.center], there);
  Removal removal{there.center, {}};
  for (const RingTriangle& t : triangles)
    removal.triangles.push_back(in_ring(
        there, {level_.vertex[star.ring[t[0]]], level_.vertex[star.ring[t[1]]], level_.vertex[star.ring[t[2]]]}));
  return removal;
}

/// The stars of a vertex and its copy. False where an edge of their fillings has been taken.
bool Simplifier::gather(int vertex) {
  const int other = seams().other_of(vertex);
  stars_.resize(other >= 0 ? 2 : 1);
  map_.complex().gather(vertex, stars_.front());
  if (other >= 0) map_.complex().gather(other, stars_.back());
  return std::none_of(stars_.begin(), stars_.end(),
                      [&](const Star& star) { return has_taken_edge(star, candidates_[star.center]); });
}

/// Makes the removal in hand.
bool Simplifier::remove() {
  if (result_.map) {
    std::vector<Removal> removals;
    for (const Star& star : stars_) removals.push_back(in_overlay(star, candidates_[star.center].triangles));
    if (!result_.map->remove(removals)) return false;
  }
  for (const Star& star : stars_) take_out(star, candidates_[star.center]);
  for (const Star& star : stars_) candidates_[star.center] = {};
  --remaining_;
  return true;
}

void Simplifier::take_out(const Star& star, const Candidate& candidate) {
  if (!result_.map) decimation_.add(of_level(star), candidate.triangles);
  const TriangleComplex& complex = map_.complex();
  for (int t : star.triangles) {
    const int other = complex.opposite(t, star.center);
    if (other < 0) continue;
    for (int v : complex.corners(other)) stale_[key(v)] = 1;
  }
  map_.remove({star.center, candidate.triangles});
  filling_.clear();
  for (const RingTriangle& t : candidate.triangles)
    filling_.push_back({star.ring[t[0]], star.ring[t[1]], star.ring[t[2]]});
  result_.removals.add(star.center, filling_);
  for (int v : star.ring) {
    const int neighbour = key(v);
    if (maps_) maps_->hold(neighbour);
    stale_[neighbour] = 1;  // on a boundary the triangles behind do not name all
    if (queued_[neighbour]) continue;
    // It could not be removed before; in its new star it may be.
    queue_.push({0.0, neighbour, ++stamp_[neighbour]});
    queued_[neighbour] = 1;
  }
}

/// The complex becomes the surface of the next level.
void Simplifier::end_level() {
  const auto step = progress_.step("take over level");
  CoarseSurface coarse = coarse_surface(map_);
  Level next{coarse.surface, std::vector<int>(level_.vertex.size(), -1), std::vector<int>(level_.face.size(), -1)};
  for (std::size_t v = 0; v < coarse.vertex.size(); ++v) next.vertex[coarse.vertex[v]] = static_cast<int>(v);
  for (std::size_t f = 0; f < coarse.slot.size(); ++f) next.face[coarse.slot[f]] = static_cast<int>(f);
  for (int& v : coarse.vertex) v = level_.vertex[v];
  for (int& t : coarse.slot) t = level_.face[t];
  decimation_.coarse = std::move(coarse);
  result_.finer.push_back(std::move(decimation_));
  level_ = std::move(next);
  decimation_ = {};
  decimation_.surface = level_.surface;
}

SimplifyResult Simplifier::run(int coarsest) {
  level_.surface = decimation_.surface = surface_;
  level_.vertex.resize(surface_->mesh.positions.size());
  level_.face.resize(surface_->mesh.faces.size());
  std::iota(level_.vertex.begin(), level_.vertex.end(), 0);
  std::iota(level_.face.begin(), level_.face.end(), 0);
  price_all();
  while (!ended_ && remaining_ > coarsest) {
    const int before = remaining_;
    {
      const auto step = progress_.step("remove vertices");
      remove_down_to(std::max(coarsest, remaining_ / kRatio));
    }
    if (before == remaining_) break;
    end_level();
    if (queue_.empty()) break;
  }
  const auto step = progress_.step("remove vertices from the map");
  result_.map.emplace(level_.surface);
  for (RemovalCost& pricer : pricers_) pricer.allow_chords();
  for (int v = 0; v < static_cast<int>(queued_.size()); ++v)  // what could not be removed before may be now
    if (key(v) == v && !queued_[v] && level_.vertex[v] >= 0 && surface_->halfedges.outgoing[v] >= 0) {
      queue_.push({0.0, v, ++stamp_[v]});
      stale_[v] = queued_[v] = 1;
    }
  remove_down_to(std::max(options_.base_vertices, 4));
  return std::move(result_);
}

}  // namespace

SimplifyResult simplify(std::shared_ptr<const Surface> surface, const ParameterizeOptions& options, int coarsest,
                        Progress& progress) {
  return Simplifier(std::move(surface), options, progress).run(coarsest);
}

int coarsest_level(const Surface& surface, const ParameterizeOptions& options) {
  const int count = used_vertices(surface);
  const int wanted = options.base_vertices > 0 ? kLevelPerBase * options.base_vertices : count / kAutomaticRatio;
  const int level = std::max(kSmallestLevel, wanted);
  return 2 * level > count ? count : level;
}

std::vector<int> remaining_vertices(const Surface& surface, const RemovalScript& removals) {
  std::vector<char> removed(surface.mesh.positions.size(), 0);
  for (int i = 0; i < removals.size(); ++i) removed[removals.vertex(i)] = 1;
  std::vector<int> remaining;
  for (std::size_t v = 0; v < removed.size(); ++v)
    if (!removed[v] && surface.halfedges.outgoing[v] >= 0) remaining.push_back(static_cast<int>(v));
  return remaining;
}

}  // namespace gsp
