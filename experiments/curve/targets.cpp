#include "experiments/curve/targets.h"

#include <fmt/format.h>

#include <algorithm>

#include "metrics/surface_distance.h"

namespace gsp {

namespace {

// A target needs a few hundredths of a decibel, not a published figure.
constexpr DistanceOptions kRuler{.samples = 200000, .seed = 1};

}  // namespace

SemiregularMesh remesh_to_error(const Parameterization& map, double max_error, RemeshOptions options,
                                Progress& progress) {
  if (!(max_error > 0.0)) throw Error(Cause::BadOption, "the largest error must be positive");
  constexpr long long kMostFaces = 64'000'000;
  constexpr int kMostLevels = 10;
  const SurfaceTree tree(map.surface);
  Progress silent;
  double error = 0.0;
  long long faces = map.base.face_count();
  for (int level = 0; level <= kMostLevels && faces <= kMostFaces; ++level, faces *= 4) {
    options.level = level;
    SemiregularMesh result = remesh(map, options, progress);
    const SurfaceDistance distance = surface_distance(map.surface, tree, result.mesh(), kRuler, silent);
    error = distance.rms() / distance.diagonal;
    progress.note(fmt::format("level {}: error {:.3g} of the diagonal", level, error));
    if (error <= max_error) return result;
  }
  throw Error(Cause::BadOption,
              fmt::format("no level reaches an error of {:.3g}; the finest has {:.3g}", max_error, error));
}

namespace {

// The least size in (least, most], to 1%, that `reaches`; `most` where none does.
template <class Reaches>
std::size_t least_size(std::size_t least, std::size_t most, Reaches reaches) {
  // Doubled up from few bytes, because a first guess in the middle of a long stream is dear and far off. The header
  // alone decodes to a mesh without extent, so the search starts a little above it.
  constexpr std::size_t kFirstBytes = 64;
  std::size_t low = least, high = std::min(most, low + kFirstBytes);
  while (high < most && !reaches(high)) {
    low = high;
    high = std::min(most, 2 * high);
  }
  // Invariant: `low` bytes are too few, `high` bytes are enough or all there are.
  while (high - low > high / 100 + 1) {
    const std::size_t middle = low + (high - low) / 2;
    (reaches(middle) ? high : low) = middle;
  }
  return high;
}

// PSNR of what streams decode to.
class StreamRuler {
 public:
  explicit StreamRuler(const SemiregularMesh& original) : reference_(original.mesh()), tree_(reference_) {}
  double psnr_db(const Bytes& stream, std::size_t bytes) const {
    Progress silent;
    return surface_distance(reference_, tree_, decode(stream, bytes).mesh(), kRuler, silent).psnr_db();
  }

 private:
  Mesh reference_;
  SurfaceTree tree_;
};

}  // namespace

std::size_t prefix_for_psnr(const Bytes& stream, const SemiregularMesh& original, double psnr_db, Progress& progress) {
  const StreamRuler ruler(original);
  return least_size(header_bytes(stream), stream.size(), [&](std::size_t bytes) {
    progress.report(fmt::format("search the prefix: {} bytes", bytes), 0.0);
    return ruler.psnr_db(stream, bytes) >= psnr_db;
  });
}

Bytes fixed_for_psnr(const SemiregularMesh& mesh, const EncodeOptions& options, const Bytes& embedded, double psnr_db,
                     Progress& progress) {
  const StreamRuler ruler(mesh);
  Progress silent;
  const std::size_t bytes = least_size(header_bytes(embedded), embedded.size(), [&](std::size_t size) {
    progress.report(fmt::format("search the size: {} bytes", size), 0.0);
    return ruler.psnr_db(encode_fixed(mesh, options, size, silent), size) >= psnr_db;
  });
  return encode_fixed(mesh, options, bytes, silent);
}

}  // namespace gsp
