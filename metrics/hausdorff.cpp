#include "metrics/hausdorff.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "metrics/surface_tree_impl.h"

namespace gsp {

namespace {

/// A point of the first surface with its distance from the second and the triangle it is nearest to.
struct Probe {
  Vec3 point;
  double distance = 0.0;
  int place = 0;
};

/// A triangle or a part of one, and an upper bound of the distance of its points.
struct Piece {
  std::array<Probe, 3> corners;
  double bound = 0.0;
  std::size_t number = 0;  ///< of appearance: makes the order of equal bounds a fixed one

  friend bool operator<(const Piece& a, const Piece& b) {
    return a.bound != b.bound ? a.bound < b.bound : a.number > b.number;
  }
};

class Bounder {
 public:
  explicit Bounder(const TriangleTree& target) : target_(target) {}

  Probe probe(const Vec3& point, int hint) const {
    Probe result{point, 0.0, hint};
    result.distance = std::sqrt(target_.nearest(point, result.place));
    return result;
  }

  /// Upper bound of the distance over a piece from its corners alone; cheap, and enough for most.
  double corner_bound(const std::array<Probe, 3>& c) const {
    double bound = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Probe &from = c[k], &next = c[(k + 1) % 3], &last = c[(k + 2) % 3];
      const double reach = std::max((next.point - from.point).norm(), (last.point - from.point).norm());
      bound = std::min(bound, from.distance + reach);
      bound = std::min(
          bound, std::max({from.distance, distance_to(from.place, next.point), distance_to(from.place, last.point)}));
    }
    return bound;
  }

  /// The same with the triangle nearest to the piece's middle, and with pairs of triangles. `middle` may raise the
  /// lower bound of the whole.
  double bound(const std::array<Probe, 3>& c, const Probe& middle) const {
    double reach = 0.0, at_middle = 0.0;
    for (const Probe& corner : c) {
      reach = std::max(reach, (corner.point - middle.point).norm());
      at_middle = std::max(at_middle, distance_to(middle.place, corner.point));
    }
    double bound = std::min({corner_bound(c), middle.distance + reach, at_middle});
    const std::array<int, 4> places = {c[0].place, c[1].place, c[2].place, middle.place};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j)
        if (places[i] != places[j]) bound = std::min(bound, pair_bound(c, places[i], places[j]));
    return bound;
  }

 private:
  double distance_to(int place, const Vec3& point) const { return std::sqrt(target_.squared_distance(place, point)); }

  /// The piece is cut where its edges are as far from one triangle as from the other, and each part is held against the
  /// triangle it is nearer to. Wherever the cut is, the bound holds; there it is smallest.
  double pair_bound(const std::array<Probe, 3>& c, int first, int second) const {
    std::array<double, 3> to_first, to_second;
    double bound = 0.0;
    for (int k = 0; k < 3; ++k) {
      to_first[k] = distance_to(first, c[k].point);
      to_second[k] = distance_to(second, c[k].point);
      bound = std::max(bound, std::min(to_first[k], to_second[k]));
    }
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      const bool nearer_first = to_first[k] <= to_second[k];
      if (nearer_first == (to_first[next] <= to_second[next])) continue;
      bound =
          std::max(bound, crossing(c[nearer_first ? k : next].point, c[nearer_first ? next : k].point, first, second));
    }
    return bound;
  }

  /// The larger of the distances to two triangles at a point of the segment from `a`, nearer to the first, to `b`,
  /// nearer to the second, where they are about the same.
  double crossing(Vec3 a, Vec3 b, int first, int second) const {
    constexpr int kHalvings = 24;
    double larger = 0.0;
    for (int i = 0; i < kHalvings; ++i) {
      const Vec3 middle = 0.5 * (a + b);
      const double to_first = distance_to(first, middle), to_second = distance_to(second, middle);
      larger = std::max(to_first, to_second);
      if (std::abs(to_first - to_second) <= 1e-4 * larger) break;
      (to_first <= to_second ? a : b) = middle;
    }
    return larger;
  }

  const TriangleTree& target_;
};

/// The search in one direction.
class Search {
 public:
  Search(const Mesh& from, const TriangleTree& to, const HausdorffOptions& options, double rounding)
      : bounder_(to), options_(options), triangles_(from.faces.size()), rounding_(rounding) {
    start(from, to);
  }

  DistanceBounds run(const std::string& stage, Progress& progress) {
    constexpr std::size_t kReportEvery = 1 << 16;
    for (; !queue_.empty() && !closed(queue_.top().bound) && may_split(); ++steps_) {
      if (steps_ % kReportEvery == 0)
        progress.report(stage, static_cast<double>(number_) / static_cast<double>(options_.most_pieces));
      const Piece piece = queue_.top();
      queue_.pop();
      split(piece);
    }
    double upper = std::max(lower_, closed_);
    if (!queue_.empty()) upper = std::max(upper, queue_.top().bound);
    return {std::max(0.0, lower_ - rounding_), upper + rounding_};
  }

 private:
  /// Whether pieces and room for them are left: a split takes one piece from the queue and may put four into it.
  bool may_split() const {
    return number_ < options_.most_pieces && queue_.size() + 3 <= triangles_ + options_.most_waiting;
  }

  /// Whether a piece with that bound needs no more looking at.
  bool closed(double bound) const { return bound <= (1.0 + options_.tolerance) * lower_ || bound <= rounding_; }

  void push(const std::array<Probe, 3>& corners, double bound) {
    ++number_;
    if (closed(bound))
      closed_ = std::max(closed_, bound);
    else
      queue_.push({corners, bound, number_});
  }

  void start(const Mesh& from, const TriangleTree& to) {
    std::vector<Probe> probes(from.positions.size());
    constexpr std::size_t kGrain = 1024;
    std::vector<char> used(from.positions.size(), 0);
    for (const Triangle& face : from.faces)
      for (int v : face) used[v] = 1;
    parallel_for(probes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      int hint = to.descend(from.positions[begin]);
      for (std::size_t v = begin; v < end; ++v)
        if (used[v]) hint = (probes[v] = bounder_.probe(from.positions[v], hint)).place;
    });
    for (const Probe& p : probes) lower_ = std::max(lower_, p.distance);
    const auto corners = [&](const Triangle& t) {
      return std::array<Probe, 3>{probes[t[0]], probes[t[1]], probes[t[2]]};
    };
    std::vector<double> bounds(from.faces.size());
    parallel_for(bounds.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) bounds[f] = bounder_.corner_bound(corners(from.faces[f]));
    });
    for (std::size_t f = 0; f < bounds.size(); ++f) push(corners(from.faces[f]), bounds[f]);
  }

  /// Looks closer at a piece, and cuts it into four at the middles of its edges if that does not close it.
  void split(const Piece& piece) {
    const auto& c = piece.corners;
    const Probe middle = probe((c[0].point + c[1].point + c[2].point) / 3.0, c[0].place);
    const double bound = std::min(piece.bound, bounder_.bound(c, middle));
    if (closed(bound)) {
      closed_ = std::max(closed_, bound);
      return;
    }
    std::array<Probe, 3> edges;
    for (int k = 0; k < 3; ++k) edges[k] = probe(0.5 * (c[k].point + c[(k + 1) % 3].point), c[k].place);
    for (int k = 0; k < 3; ++k) add({c[k], edges[k], edges[(k + 2) % 3]}, bound);
    add(edges, bound);
  }

  void add(const std::array<Probe, 3>& corners, double parent) {
    push(corners, std::min(parent, bounder_.corner_bound(corners)));
  }

  Probe probe(const Vec3& point, int hint) {
    const Probe result = bounder_.probe(point, hint);
    lower_ = std::max(lower_, result.distance);
    return result;
  }

  Bounder bounder_;
  const HausdorffOptions& options_;
  std::size_t triangles_;
  double rounding_;
  std::priority_queue<Piece> queue_;
  double lower_ = 0.0, closed_ = 0.0;  ///< largest distance seen, largest bound of a closed piece
  std::size_t number_ = 0, steps_ = 0;
};

}  // namespace

DistanceBounds HausdorffBounds::both() const {
  return {std::max(forward.lower, backward.lower), std::max(forward.upper, backward.upper)};
}

HausdorffBounds hausdorff_bounds(const Mesh& a, const Mesh& b, const HausdorffOptions& options, Progress& progress) {
  return hausdorff_bounds(a, SurfaceTree(a), b, SurfaceTree(b), options, progress);
}

HausdorffBounds hausdorff_bounds(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                                 const HausdorffOptions& options, Progress& progress) {
  if (!(options.tolerance >= HausdorffOptions::kLeastTolerance && options.tolerance <= 1.0))
    throw Error(Cause::BadOption, "the tolerance of the Hausdorff bounds is between 1e-6 and 1");
  const double rounding = distance_rounding(a, b);  // bounds are widened by it
  HausdorffBounds result;
  result.forward = Search(a, tree_b.impl().tree, options, rounding).run("Hausdorff forward", progress);
  result.backward = Search(b, tree_a.impl().tree, options, rounding).run("Hausdorff backward", progress);
  return result;
}

}  // namespace gsp
