#include "mesh/nearest/triangle_tree.h"

#include <array>
#include <bit>
#include <cfloat>
#include <limits>

#include <Eigen/Geometry>

#include "mesh/error.h"
#include "mesh/parallel.h"
#include "mesh/topology.h"

/// Compiles a function with all it calls again for AVX2 and AVX-512, chosen when the program starts. The bits are the
/// same: lanes work alone, in the same order of operations, and contraction is off.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
#define GSP_VECTOR_CLONES __attribute__((target_clones("arch=x86-64-v4", "avx2", "default"), flatten))
#else
#define GSP_VECTOR_CLONES
#endif

namespace gsp {

namespace {

using Lanes = float __attribute__((vector_size(64)));

/// Boxes are widened by this much of the unit box, four times what the conversion to float can lose.
constexpr float kOutward = 0x1.0p-22f;
/// Queries farther out are moved onto this box around the tree: that only brings them nearer to everything inside.
constexpr float kFarthest = 1e15f;

/// Ranges up to four times this many entries are sorted to the end by one thread, within its cache.
constexpr std::size_t kWithinCache = 4096;

/// A group is at most this many times as large as the triangle it is near; measured best from sparse to dense samples.
constexpr double kGroupReach = 2.0;

struct Entry {
  std::array<float, 3> centre;
  int face;
};

/// Parts [begin, end) of the entries at multiples of `quarter` along the longest axes, each part apart from the others.
void split_in_four(std::vector<Entry>& entries, std::size_t begin, std::size_t end, std::size_t quarter) {
  const auto halve = [&](std::size_t from, std::size_t middle, std::size_t to) {
    if (middle >= to) return;
    std::array<float, 3> low = entries[from].centre, high = low;
    for (std::size_t i = from; i < to; ++i)
      for (int k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], entries[i].centre[k]);
        high[k] = std::max(high[k], entries[i].centre[k]);
      }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    std::nth_element(entries.begin() + from, entries.begin() + middle, entries.begin() + to,
                     [axis](const Entry& a, const Entry& b) {
                       return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.face < b.face;
                     });
  };
  const std::size_t middle = begin + 2 * quarter;
  halve(begin, middle, end);
  halve(begin, begin + quarter, std::min(middle, end));
  halve(middle, middle + quarter, end);
}

/// Sorts [begin, end) down to single entries, for ranges that fit into a core's cache.
void split_all(std::vector<Entry>& entries, std::size_t begin, std::size_t end, std::size_t quarter) {
  if (end - begin <= 1) return;
  split_in_four(entries, begin, end, quarter);
  if (quarter > 1)
    for (std::size_t b = begin; b < end; b += quarter) split_all(entries, b, std::min(b + quarter, end), quarter / 4);
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  require_finite_surface(mesh);
  set_scale(mesh);
  sort_places(mesh);
  build_frames(mesh);
  build_boxes(mesh);
}

TriangleTree::TriangleTree(const Mesh& mesh, const TriangleTree& like) : order_(like.order_), place_(like.place_) {
  if (mesh.faces.size() != order_.size())
    throw Error(Cause::BadOption, "a tree of another number of faces does not say how these are ordered");
  require_finite_surface(mesh);
  set_scale(mesh);
  build_frames(mesh);
  build_boxes(mesh);
}

void TriangleTree::set_scale(const Mesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Triangle& face : mesh.faces)
    for (int vertex : face) box.extend(mesh.positions[vertex]);
  centre_ = box.center();
  const double extent = 0.5 * box.sizes().maxCoeff();
  if (extent > 0.0) scale_ = 1.0 / extent;
}

void TriangleTree::build_frames(const Mesh& mesh) {
  frames_.resize(order_.size());
  areas_.resize(order_.size());
  parallel_for(order_.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Triangle& t = mesh.faces[order_[i]];
      frames_[i] = TriangleFrame(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]);
      areas_[i] = face_area(mesh, order_[i]);
    }
  });
}

float TriangleTree::scaled(double value, int axis) const {
  return static_cast<float>((value - centre_[axis]) * scale_);
}

void TriangleTree::sort_places(const Mesh& mesh) {
  const std::size_t count = mesh.faces.size();
  std::vector<Entry> entries(count);
  parallel_for(count, 8192, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      entries[f].face = static_cast<int>(f);
      for (int k = 0; k < 3; ++k) {
        const Triangle& t = mesh.faces[f];
        const double a = mesh.positions[t[0]][k], b = mesh.positions[t[1]][k], c = mesh.positions[t[2]][k];
        entries[f].centre[k] = scaled(0.5 * (std::min({a, b, c}) + std::max({a, b, c})), k);
      }
    }
  });
  std::size_t quarter = 1;
  while (4 * quarter < count) quarter *= 4;
  for (; quarter > kWithinCache; quarter /= 4)
    parallel_for((count + 4 * quarter - 1) / (4 * quarter), 1, [&](std::size_t first, std::size_t last) {
      for (std::size_t r = first; r < last; ++r)
        split_in_four(entries, r * 4 * quarter, std::min((r + 1) * 4 * quarter, count), quarter);
    });
  parallel_for((count + 4 * quarter - 1) / (4 * quarter), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r)
      split_all(entries, r * 4 * quarter, std::min((r + 1) * 4 * quarter, count), quarter);
  });
  order_.resize(count);
  place_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    order_[i] = entries[i].face;
    place_[order_[i]] = static_cast<int>(i);
  }
}

void TriangleTree::build_boxes(const Mesh& mesh) {
  Node empty;
  for (int k = 0; k < 3; ++k)
    for (int c = 0; c < kWidth; ++c) {
      empty.low[k][c] = FLT_MAX;
      empty.high[k][c] = -FLT_MAX;
    }
  levels_.emplace_back((order_.size() + kWidth - 1) / kWidth, empty);
  parallel_for(levels_[0].size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin * kWidth; i < std::min(end * kWidth, order_.size()); ++i) {
      const Triangle& t = mesh.faces[order_[i]];
      Node& node = levels_[0][i / kWidth];
      for (int k = 0; k < 3; ++k) {
        const double a = mesh.positions[t[0]][k], b = mesh.positions[t[1]][k], c = mesh.positions[t[2]][k];
        node.low[k][i % kWidth] = scaled(std::min({a, b, c}), k) - kOutward;
        node.high[k][i % kWidth] = scaled(std::max({a, b, c}), k) + kOutward;
      }
    }
  });
  while (levels_.back().size() > 1) {
    const std::vector<Node>& below = levels_.back();
    std::vector<Node> level((below.size() + kWidth - 1) / kWidth, empty);
    for (std::size_t i = 0; i < below.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        level[i / kWidth].low[k][i % kWidth] = *std::min_element(below[i].low[k], below[i].low[k] + kWidth);
        level[i / kWidth].high[k][i % kWidth] = *std::max_element(below[i].high[k], below[i].high[k] + kWidth);
      }
    levels_.push_back(std::move(level));
  }
}

template <int G>
TriangleTree::QueryBox TriangleTree::query_box(const PointGroup<G>& points) const {
  const double* coordinates[3] = {points.x, points.y, points.z};
  QueryBox box;
  for (int k = 0; k < 3; ++k) {
    double low = coordinates[k][0], high = low;
    for (int i = 1; i < G; ++i) {
      low = std::min(low, coordinates[k][i]);
      high = std::max(high, coordinates[k][i]);
    }
    const float scaled_low = scaled(low, k), scaled_high = scaled(high, k);
    box.low[k] = std::clamp(scaled_low - kOutward * (1.0f + std::abs(scaled_low)), -kFarthest, kFarthest);
    box.high[k] = std::clamp(scaled_high + kOutward * (1.0f + std::abs(scaled_high)), -kFarthest, kFarthest);
  }
  return box;
}

template <int G>
float TriangleTree::bound(const double* squared) const {
  double largest = squared[0];
  for (int i = 1; i < G; ++i) largest = std::max(largest, squared[i]);
  // Widened by more than the rounding of the box distances in float.
  const double widened = largest * scale_ * scale_ * (1.0 + 0x1.0p-19) + FLT_MIN;
  return static_cast<float>(std::min(widened, 0x1.0p126));
}

void TriangleTree::distances(const Node& node, const QueryBox& box, float* squared) {
  Lanes sum = {};
  for (int k = 0; k < 3; ++k) {
    const Lanes low = *reinterpret_cast<const Lanes*>(node.low[k]),
                high = *reinterpret_cast<const Lanes*>(node.high[k]);
    const Lanes below = low - box.high[k], above = box.low[k] - high;
    Lanes gap = below > above ? below : above;
    const Lanes zero = {};
    gap = gap > zero ? gap : zero;
    sum += gap * gap;
  }
  *reinterpret_cast<Lanes*>(squared) = sum;
}

std::uint32_t TriangleTree::within(const Node& node, const QueryBox& box, float limit, float* squared) {
  distances(node, box, squared);
  std::uint32_t children = 0;
  for (int c = 0; c < kWidth; ++c) children |= static_cast<std::uint32_t>(squared[c] <= limit) << c;
  return children;
}

template <int G>
void TriangleTree::search(const PointGroup<G>& points, double* squared, int& hint) const {
  const QueryBox box = query_box(points);
  std::fill(squared, squared + G, std::numeric_limits<double>::infinity());
  nearer<G>(frames_[hint], points, squared);
  float limit = bound<G>(squared);

  struct Pending {
    std::uint32_t node;
    int level;
    float distance;
  };
  // A node leaves at most fifteen siblings behind on each of at most eight levels.
  Pending stack[128];
  int depth = 0;
  stack[depth++] = {0, static_cast<int>(levels_.size()) - 1, 0.0f};
  while (depth > 0) {
    const Pending top = stack[--depth];
    if (top.distance > limit) continue;
    alignas(64) float distance[kWidth];
    std::uint32_t children = within(levels_[top.level][top.node], box, limit, distance);
    if (top.level == 0) {
      for (; children != 0; children &= children - 1) {
        const int c = std::countr_zero(children);
        if (distance[c] > limit) continue;
        const int triangle = static_cast<int>(kWidth * top.node) + c;
        const double before = squared[G - 1];
        nearer<G>(frames_[triangle], points, squared);
        if (squared[G - 1] < before) hint = triangle;
        limit = bound<G>(squared);
      }
      continue;
    }
    // Farthest first onto the stack, so that the nearest child is next.
    const int first = depth;
    for (; children != 0; children &= children - 1) {
      const int c = std::countr_zero(children);
      int at = depth++;
      while (at > first && stack[at - 1].distance < distance[c]) {
        stack[at] = stack[at - 1];
        --at;
      }
      stack[at] = {kWidth * top.node + c, top.level - 1, distance[c]};
    }
  }
}

GSP_VECTOR_CLONES void TriangleTree::nearest(const PointGroup<kGroupSize>& points, double* squared, int& hint) const {
  search<kGroupSize>(points, squared, hint);
}

GSP_VECTOR_CLONES double TriangleTree::nearest(const Vec3& point, int& hint) const {
  const PointGroup<1> single = {{point.x()}, {point.y()}, {point.z()}};
  double squared = 0.0;
  search<1>(single, &squared, hint);
  return squared;
}

double TriangleTree::squared_distance(int place, const Vec3& point) const {
  double squared = std::numeric_limits<double>::infinity();
  nearer<1>(frames_[place], {{point.x()}, {point.y()}, {point.z()}}, &squared);
  return squared;
}

double TriangleTree::squared_plane_distance(int place, const Vec3& point) const {
  const TriangleFrame& t = frames_[place];
  const Vec3 offset = point - t.origin;
  if (t.height > 0.0) return std::pow(offset.dot(t.x_axis.cross(t.y_axis)), 2);
  if (t.length > 0.0) return offset.cross(t.x_axis).squaredNorm();
  return offset.squaredNorm();
}

GSP_VECTOR_CLONES int TriangleTree::descend(const Vec3& point) const {
  const QueryBox box = query_box(PointGroup<1>{{point.x()}, {point.y()}, {point.z()}});
  std::size_t node = 0;
  for (std::size_t level = levels_.size(); level-- > 0;) {
    alignas(64) float distance[kWidth];
    distances(levels_[level][node], box, distance);
    node = kWidth * node + (std::min_element(distance, distance + kWidth) - distance);
  }
  return static_cast<int>(node);
}

void squared_distances(const TriangleTree& target, const Vec3* points, std::size_t count, double* squared) {
  int hint = target.descend(points[0]);
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    const double reach = kGroupReach * target.size(hint);
    PointGroup<kGroupSize> group;
    Vec3 low = points[begin], high = low;
    for (; end < count && end - begin < kGroupSize; ++end) {
      const Vec3& p = points[end];
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      if (end > begin && (high - low).maxCoeff() > reach) break;
      group.set(end - begin, p);
    }
    for (std::size_t i = end - begin; i < kGroupSize; ++i) group.set(i, points[end - 1]);
    double nearest[kGroupSize];
    target.nearest(group, nearest, hint);
    std::copy(nearest, nearest + (end - begin), squared + begin);
  }
}

}  // namespace gsp
