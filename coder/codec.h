#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coder/bitplane_coder.h"
#include "coder/wavelet_transform.h"
#include "mesh/export.h"
#include "mesh/progress.h"
#include "remesh/semiregular.h"

namespace GSP_PUBLIC gsp {

using Bytes = std::vector<std::uint8_t>;

const char* wavelet_name(Wavelet wavelet);

/// The inverse. Throws Error(BadOption).
Wavelet wavelet_of(const std::string& name);

struct EncodeOptions {
  /// Loop is the transform with which the paper compares maps. `gsp encode` takes lifted Butterfly, which codes better.
  Wavelet wavelet = Wavelet::Loop;
  /// Bits per coordinate of the finest quantization of normal components relative to the bounding box, 8..24, or as
  /// many as the remesh is worth (coder/precision.h; 16 where it has no levels). It sets where the stream ends: the
  /// whole stream codes every coefficient to about this step, times the inverse square root of the local over the mean
  /// triangle area. At most 25 less the number of levels is used.
  static constexpr int kAutoPrecision = 0;
  int precision_bits = kAutoPrecision;
  /// Largest step of tangential components over that of normal ones, a power of two: 1, 2, 4, 8. It is reached where
  /// the surface is flat and smooth (coder/importance.h); where normals vary, steps are closer to equal.
  int tangential_ratio = 8;
};

/// What the whole stream is made of.
struct StreamParts {
  std::size_t header_bytes = 0;  ///< without the connectivity
  std::size_t connectivity_bytes = 0;
  BitplaneParts bits;
};

/// Codes a semi-regular mesh as an embedded stream: a checksummed header with the base connectivity, then bit-planes,
/// most significant first. Any prefix that holds the header decodes (design.md, `*.pgc`).
///
/// A mesh whose details, but for those of boundary edges, have no tangential part to the stream's precision, becomes a
/// scalar stream: tangential components take no bits then.
///
/// A displaced mesh becomes a stream of its control mesh and displacements (coder/displaced); its header holds the
/// control points.
///
/// A decoder numbers base vertices and faces, and with them all finer vertices, in the order in which they were coded;
/// `coded_vertex_order` (coder/coded_order.h) says which vertex became which.
/// `parts`, where given, receives the sizes. Throws Error: BadOption, NoFaces, NonFinite, Malformed (a base vertex
/// without a face), SolverFailed, and the errors of `base_level`.
Bytes encode(const SemiregularMesh& mesh, const EncodeOptions& options, Progress& progress,
             StreamParts* parts = nullptr);

/// Codes a semi-regular mesh for one size: as `encode`, and at most `bytes` long, but integers are chosen for a decoder
/// that stops there: in the frames that it will have, and significant where that is worth its bits
/// (coder/rate_distortion.h). Several choices are tried, that of the embedded stream among them, and the one that moves
/// the surface least along its normals is taken. Its prefixes decode too, to less than those of the embedded stream.
/// About ten times the time of `encode`. Of a displaced mesh it is the prefix of the embedded stream. Throws what
/// `encode` throws, and Error(BadOption) where `bytes` does not hold the header.
Bytes encode_fixed(const SemiregularMesh& mesh, const EncodeOptions& options, std::size_t bytes, Progress& progress);

/// Number of bytes that a prefix needs at least. Throws Error(BadStream).
std::size_t header_bytes(const Bytes& stream);

/// Decodes the first `budget` bytes of the stream (all of them where it is larger). Hostile bytes are safe: memory is
/// under 100 MB for the first 2^19 faces and less than 1 MB for each further byte. A prefix too short for its finest
/// levels, less than a byte for 2048 faces, decodes to the level that it can hold.
/// Throws Error: BadStream where the header is damaged, Truncated where the budget does not hold it.
SemiregularMesh decode(const Bytes& stream, std::size_t budget);

}  // namespace gsp
