#include "metrics/metro.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/bounding_box.h"
#include "mesh/error.h"
#include "mesh/parallel.h"
#include "metrics/surface_tree_impl.h"

namespace gsp {

namespace {

constexpr std::size_t kSamplesPerFace = 10;
constexpr double kInflation = 0.02;

/// Collects points and measures them a batch at a time, each batch in blocks on all threads.
class Batches {
 public:
  explicit Batches(const TriangleTree& target) : target_(target) { points_.reserve(kBatch); }

  void add(const Vec3& point) {
    points_.push_back(point);
    if (points_.size() == kBatch) flush();
  }

  void flush() {
    if (points_.empty()) return;
    squared_.resize(points_.size());
    parallel_for(points_.size(), kBlock, [&](std::size_t begin, std::size_t end) {
      squared_distances(target_, points_.data() + begin, end - begin, squared_.data() + begin);
    });
    for (double s : squared_) {
      sum_ += std::sqrt(s);
      squares_ += s;
      largest_ = std::max(largest_, s);
    }
    count_ += points_.size();
    points_.clear();
  }

  std::size_t count() const { return count_ + points_.size(); }
  double mean() const { return sum_ / static_cast<double>(count_); }
  double rms() const { return std::sqrt(squares_ / static_cast<double>(count_)); }
  double maximum() const { return std::sqrt(largest_); }

 private:
  static constexpr std::size_t kBlock = 4096, kBatch = 64 * kBlock;
  const TriangleTree& target_;
  std::vector<Vec3> points_;
  std::vector<double> squared_;
  double sum_ = 0.0, squares_ = 0.0, largest_ = 0.0;
  std::size_t count_ = 0;
};

std::size_t sample_vertices(const Mesh& mesh, Batches& batches) {
  std::vector<char> used(mesh.positions.size(), 0);
  for (const Triangle& face : mesh.faces)
    for (int v : face) used[v] = 1;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v]) batches.add(mesh.positions[v]);
  return batches.count();
}

/// Steps of equal length on every edge, ends left out; what an edge is short of a sample goes to the next one.
std::size_t sample_edges(const Mesh& mesh, double per_length, Batches& batches) {
  std::vector<std::array<int, 2>> edges;
  for (const Triangle& t : mesh.faces)
    for (int k = 0; k < 3; ++k) edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const std::size_t before = batches.count();
  double owed = 0.0;
  for (const auto& [from, to] : edges) {
    const Vec3 &a = mesh.positions[from], &b = mesh.positions[to];
    owed += (b - a).norm() * per_length;
    const double steps = std::floor(owed);
    for (double i = 1.0; i <= steps; ++i) batches.add(a + i / (steps + 1.0) * (b - a));
    owed -= steps;
  }
  return batches.count() - before;
}

/// The inner points of a triangular grid in each face, as many as fit under what the face is owed.
std::size_t sample_faces(const Mesh& mesh, double per_area, Batches& batches) {
  const std::size_t before = batches.count();
  double owed = 0.0;
  for (int f = 0; f < mesh.face_count(); ++f) {
    owed += face_area(mesh, f) * per_area;
    const double wanted = std::floor(owed);
    if (wanted < 1.0) continue;
    const int per_edge = static_cast<int>((std::sqrt(1.0 + 8.0 * wanted) + 5.0) / 2.0);
    const Vec3& a = mesh.positions[mesh.faces[f][0]];
    const Vec3 u = (mesh.positions[mesh.faces[f][1]] - a) / (per_edge - 1),
               v = (mesh.positions[mesh.faces[f][2]] - a) / (per_edge - 1);
    for (int i = 1; i < per_edge - 1; ++i)
      for (int j = 1; j < per_edge - 1 - i; ++j) {
        batches.add(a + i * u + j * v);
        owed -= 1.0;
      }
  }
  return batches.count() - before;
}

MetroDistance one_way(const Mesh& from, const TriangleTree& to, std::size_t samples, const std::string& stage,
                      Progress& progress) {
  const double area = surface_area(from);
  if (!(area > 0.0)) throw Error(Cause::NoFaces, "a surface without area has no samples");
  Batches batches(to);
  MetroDistance result;
  progress.report(stage, 0.0);
  result.vertex_samples = sample_vertices(from, batches);
  auto target = static_cast<double>(samples) - static_cast<double>(result.vertex_samples);
  if (target > 0.0) {
    result.edge_samples = sample_edges(from, std::sqrt(target / area), batches);
    progress.report(stage, 0.3);
    // Metro takes all samples so far off its target a second time, vertices included.
    target -= static_cast<double>(batches.count());
    if (target > 0.0) result.face_samples = sample_faces(from, target / area, batches);
  }
  batches.flush();
  progress.report(stage, 1.0);
  result.mean = batches.mean();
  result.rms = batches.rms();
  result.maximum = batches.maximum();
  return result;
}

double inflated_diagonal(const Mesh& a, const Mesh& b) {
  const Eigen::AlignedBox3d box = bounding_box(a).merged(bounding_box(b));
  const double offset = kInflation * box.diagonal().norm();
  return (box.sizes() + Vec3::Constant(2.0 * offset)).norm();
}

}  // namespace

MetroDistances metro_distances(const Mesh& a, const SurfaceTree& tree_a, const Mesh& b, const SurfaceTree& tree_b,
                               std::size_t samples, Progress& progress) {
  constexpr std::size_t kMost = 2'000'000'000;
  if (samples > kMost) throw Error(Cause::BadOption, "Metro takes at most 2e9 samples");
  if (samples == 0) samples = kSamplesPerFace * std::max(a.faces.size(), b.faces.size());
  MetroDistances result;
  result.forward = one_way(a, tree_b.impl().tree, samples, "Metro forward", progress);
  result.backward = one_way(b, tree_a.impl().tree, samples, "Metro backward", progress);
  result.diagonal = inflated_diagonal(a, b);
  return result;
}

}  // namespace gsp
