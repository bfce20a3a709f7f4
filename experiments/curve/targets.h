#pragma once

#include <cstddef>

#include "coder/codec.h"
#include "mesh/progress.h"
#include "param/map/parameterization.h"
#include "remesh/remesh.h"

namespace gsp {

/// Remesh by `options`, but at the first level whose RMS distance to the surface (larger of both directions, over the
/// surface's bounding-box diagonal) is at most `max_error`. Throws Error(BadOption) where `max_error` is not positive
/// or not reached at the finest level of at most 64 million faces, and what `remesh` throws.
SemiregularMesh remesh_to_error(const Parameterization& map, double max_error, RemeshOptions options,
                                Progress& progress);

/// Shortest prefix (to 1%) of the stream whose decoded surface is at least `psnr_db` from `original`, the mesh that was
/// encoded. The whole stream where none is. Throws what `decode` throws.
std::size_t prefix_for_psnr(const Bytes& stream, const SemiregularMesh& original, double psnr_db, Progress& progress);

/// The stream of `encode_fixed` for the least size (to 1%) at which its decoded surface is at least `psnr_db` from
/// `mesh`; for the size of the whole embedded stream where none is. `embedded` is that stream, of the same options.
/// Throws what `encode_fixed` throws.
Bytes fixed_for_psnr(const SemiregularMesh& mesh, const EncodeOptions& options, const Bytes& embedded, double psnr_db,
                     Progress& progress);

}  // namespace gsp
