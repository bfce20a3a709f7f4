#include "experiments/curve/meter.h"

#include "experiments/version.h"

namespace gsp {

Meter::Meter(const Mesh& mesh, const std::string& model, std::uint64_t seed)
    : mesh_(mesh), model_(model), seed_(seed), tree_(mesh) {}

CurvePoint Meter::measure(const Mesh& decoded, std::size_t bytes, std::size_t samples, Progress& progress) const {
  return measure(decoded, SurfaceTree(decoded), bytes, samples, progress);
}

CurvePoint Meter::measure(const Mesh& decoded, const SurfaceTree& tree, std::size_t bytes, std::size_t samples,
                          Progress& progress) const {
  const SurfaceDistance distance = surface_distance(mesh_, tree_, decoded, tree, {samples, seed_}, progress);
  CurvePoint point;
  point.model = model_;
  point.bytes = bytes;
  point.bits_per_vertex = 8.0 * static_cast<double>(bytes) / mesh_.vertex_count();
  point.faces = decoded.face_count();
  point.psnr_db = distance.psnr_db();
  point.samples = samples;
  point.seed = seed_;
  point.version = version();
  if (distance.exact()) return point;  // all distances are 0
  point.rms_forward = distance.forward.rms / distance.diagonal;
  point.rms_backward = distance.backward.rms / distance.diagonal;
  point.rms = distance.rms() / distance.diagonal;
  point.hausdorff = distance.hausdorff() / distance.diagonal;
  point.standard_error_db = distance.standard_error_db();
  return point;
}

}  // namespace gsp
