#include "experiments/base/level_by_rate.h"

#include <string>
#include <utility>

#include "experiments/base/map_worth.h"
#include "metrics/psnr.h"
#include "metrics/surface_distance.h"
#include "remesh/remesh.h"

namespace gsp {

namespace {

constexpr double kBinding = 4.0;  // dB between 16 KB of the stream and the remesh under which the level cuts it off
constexpr std::size_t kMostLevelFaces = std::size_t{1} << 20;
constexpr DistanceOptions kLevelRuler{.samples = 10000};

struct Judged {
  SemiregularMesh mesh;
  double psnr_db = 0.0;  ///< mean over the budgets
  bool binds = false;    ///< the level is what keeps the stream from being nearer
};

Judged judged(SemiregularMesh mesh, const Mesh& surface, const SurfaceTree& tree, Progress& progress) {
  const Bytes stream = rated_stream(mesh, progress);
  Progress silent;
  Judged result{std::move(mesh)};
  double last = 0.0;
  for (std::size_t budget : kRatedBytes) {
    if (budget <= header_bytes(stream)) continue;  // the same ones at any level
    last = prefix_psnr(surface, tree, stream, budget, kLevelRuler, silent).value_or(0.0);
    result.psnr_db += last / static_cast<double>(kRatedBytes.size());
  }
  if (last > 0.0) {
    const SurfaceDistance distance = surface_distance(surface, tree, result.mesh.mesh(), kLevelRuler, silent);
    result.binds = diagonal_psnr(distance).db - last < kBinding;
  }
  return result;
}

}  // namespace

SemiregularMesh remesh_by_rate(const Parameterization& map, RemeshOptions options, Progress& progress) {
  SemiregularMesh first = remesh(map, options, progress);
  if (options.level != RemeshOptions::kAutoLevel || options.kind != RemeshKind::Parametric) return first;
  const auto can_be_finer = [](const SemiregularMesh& mesh) {
    return mesh.level < kMaxSubdivisionLevel && mesh.base_faces.size() << (2 * (mesh.level + 1)) <= kMostLevelFaces;
  };
  if (!can_be_finer(first)) return first;
  const SurfaceTree tree(map.surface);
  Judged best = judged(std::move(first), map.surface, tree, progress);
  while (best.binds && can_be_finer(best.mesh)) {
    options.level = best.mesh.level + 1;
    Judged finer = judged(remesh(map, options, progress), map.surface, tree, progress);
    if (!(finer.psnr_db > best.psnr_db)) break;
    progress.note("level " + std::to_string(finer.mesh.level) + ": a coarser one would cut off streams of 1 to 16 KB");
    best = std::move(finer);
  }
  return std::move(best.mesh);
}

}  // namespace gsp
