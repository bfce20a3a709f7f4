#include "experiments/base/level_by_rate.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/base/map_worth.h"
#include "metrics/psnr.h"
#include "metrics/surface_distance.h"
#include "remesh/remesh.h"

namespace gsp {

namespace {

constexpr double kBinding = 4.0;  // dB between 16 KB of the stream and the remesh under which the level cuts it off
constexpr std::size_t kMostLevelFaces = std::size_t{1} << 20;
constexpr DistanceOptions kLevelRuler{.samples = 10000};

/// A level, as the stream of its remesh is worth.
class JudgedLevel {
 public:
  /// `surface` and `tree` are kept by reference.
  JudgedLevel(SemiregularMesh remesh, const Mesh& surface, const SurfaceTree& tree, Progress& progress)
      : mesh(std::move(remesh)), surface_(&surface), tree_(&tree), stream_(rated_stream(mesh, progress)) {}

  /// Whether the level is what keeps the largest prefix from being nearer.
  bool binds() {
    const double largest = at(kRatedBytes.size() - 1);
    if (largest == 0.0) return false;
    Progress silent;
    const SurfaceDistance distance = surface_distance(*surface_, *tree_, mesh.mesh(), kLevelRuler, silent);
    return diagonal_psnr(distance).db - largest < kBinding;
  }

  /// PSNR in dB, over the budgets.
  double mean() {
    double sum = 0.0;
    for (std::size_t i = 0; i < kRatedBytes.size(); ++i) sum += at(i);
    return sum / static_cast<double>(kRatedBytes.size());
  }

  SemiregularMesh mesh;

 private:
  /// PSNR of a prefix, measured once; 0 where it holds no more than the header, which is the same at any level.
  double at(std::size_t budget) {
    if (kRatedBytes[budget] <= header_bytes(stream_)) return 0.0;
    Progress silent;
    if (!known_[budget])
      known_[budget] = prefix_psnr(*surface_, *tree_, stream_, kRatedBytes[budget], kLevelRuler, silent).value_or(0.0);
    return *known_[budget];
  }

  const Mesh* surface_;
  const SurfaceTree* tree_;
  Bytes stream_;
  std::vector<std::optional<double>> known_ = std::vector<std::optional<double>>(kRatedBytes.size());
};

}  // namespace

SemiregularMesh remesh_by_rate(const Parameterization& map, RemeshOptions options, Progress& progress) {
  SemiregularMesh first = remesh(map, options, progress);
  if (options.level != RemeshOptions::kAutoLevel || options.kind != RemeshKind::Parametric) return first;
  const auto can_be_finer = [](const SemiregularMesh& mesh) {
    return mesh.level < kMaxSubdivisionLevel && mesh.base_faces.size() << (2 * (mesh.level + 1)) <= kMostLevelFaces;
  };
  if (!can_be_finer(first)) return first;
  const SurfaceTree tree(map.surface);
  JudgedLevel best(std::move(first), map.surface, tree, progress);
  while (can_be_finer(best.mesh) && best.binds()) {
    options.level = best.mesh.level + 1;
    JudgedLevel finer(remesh(map, options, progress), map.surface, tree, progress);
    if (!(finer.mean() > best.mean())) break;
    progress.note("level " + std::to_string(finer.mesh.level) + ": a coarser one would cut off streams of 1 to 16 KB");
    best = std::move(finer);
  }
  return std::move(best.mesh);
}

}  // namespace gsp
