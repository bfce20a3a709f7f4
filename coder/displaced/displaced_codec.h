#pragma once

#include "coder/codec.h"
#include "coder/header.h"

namespace gsp {

// Streams of displaced meshes (docs/pgc.md): the control mesh is in the header, the payload holds one number a vertex,
// and two on boundaries, as wavelet coefficients in embedded bit-planes.

/// A displaced mesh as `encode` writes it. `diagonal`: of its bounding box; `precision`: kPassesPerPlane to a bit, for
/// the finest step relative to it. Throws Error: BadOption, where control points span more than the stream can number;
/// the errors of `displaced_form` and `base_level`; SolverFailed.
Bytes encode_displaced(const SemiregularMesh& mesh, Wavelet wavelet, double diagonal, int precision, Progress& progress,
                       StreamParts* parts);

/// The inverse, of the payload [begin, end), at `level`. `area_level`: the finest that any prefix decodes to. Throws
/// Error(BadStream) where the payload is damaged.
SemiregularMesh decode_displaced(const StreamHeader& header, int level, int area_level, const std::uint8_t* begin,
                                 const std::uint8_t* end);

}  // namespace gsp
