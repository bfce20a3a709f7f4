#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coder/base_connectivity.h"
#include "coder/codec.h"
#include "coder/displaced/control_points.h"
#include "remesh/filters/displacement.h"
#include "remesh/filters/local_frames.h"

namespace gsp {

/// How many numbers of a vertex above the base a stream holds. Values, at most 3, are those on disk.
enum class StreamKind : std::uint8_t {
  Parametric = 0,  ///< three
  Normal = 1,      ///< one, along the normal of its edge's frame; three on boundaries and creases
  Displaced = 2,   ///< one, along the normals of a control mesh's surface; two on the boundary
};
inline constexpr int kStreamKinds = 3;

/// The version that is written of displaced kinds; the others are those of 9. Of 9, displaced ones have boundaries that
/// carry nothing along. Those of 8 and 7, which have frames of their own, the latter no creases, and of 6, all
/// parametric, are read too.
inline constexpr std::uint8_t kStreamVersion = 10;

/// Everything that a decoder needs before the first bit-plane. On disk (`*.pgc`):
///
///     "PGC"  version  CRC-32 of version and rest (little endian)  varint size of the rest
///     rest: wavelet | creases << 3 | log2(tangential ratio) << 4 | kind << 6, level, base planes, detail planes (one
///     byte each);
///           varints: base faces, zigzag step exponent, zigzag origin x, y, z; base connectivity, then creases
///     of kind displaced, before the base connectivity: varints zigzag 4 exponent + mantissa - 4 of the control points'
///           grid, bytes of the control points; these
///
/// A varint holds 7 bits a byte, least significant first, at most 9 bytes.
struct StreamHeader {
  StreamKind kind = StreamKind::Parametric;
  Wavelet wavelet = Wavelet::Loop;
  int tangential_ratio = 4;
  FrameRule frames = FrameRule::ByArea;     ///< follows from the version
  AcrossRule across = AcrossRule::Carried;  ///< follows from the version
  int level = 0;
  int base_planes = 0;
  int detail_planes = 0;
  int step_exponent = 0;                    ///< the step of normal details of the finest level is 2^step_exponent
  std::array<std::int64_t, 3> origin = {};  ///< of the base positions, in units of 2^(base_planes - 3) base steps
  CodedBase base;
  std::vector<ControlSteps>
      control;  ///< #B of kind displaced: control points from the origin, which counts their steps
  double control_grid = 0.0;
};

/// The largest decoded mesh, in faces of its finest level: bounds memory and time against hostile headers.
inline constexpr std::int64_t kMaxDecodedFaces = 50'000'000;

/// Meshes of so many faces are decoded from any prefix; finer levels of larger ones need bytes that speak of them.
inline constexpr std::int64_t kFreeFaces = 1 << 19;

/// The finest level, at most the stream's, with no more than so many faces.
int finest_level(const StreamHeader& header, std::int64_t faces);

/// Level of the reconstruction that importance is read from, at most: as coarse as what any prefix decodes to.
int importance_level(const StreamHeader& header);

/// `connectivity` is what `encode_connectivity` wrote for `header.base`.
Bytes write_header(const StreamHeader& header, const Bytes& connectivity);

/// Writes the checksum of the header that `stream` starts with, whatever the header says. Throws Error(BadStream) where
/// it is cut off.
void seal_header(Bytes& stream);

/// Bytes of the header that `stream` starts with, without reading more than its first 17 bytes. Throws Error(BadStream)
/// where it is no gsp stream.
std::size_t header_size(const std::uint8_t* begin, const std::uint8_t* end);

/// Throws Error(BadStream) on any damage; checks every count before it takes memory.
StreamHeader read_header(const std::uint8_t* begin, const std::uint8_t* end);

}  // namespace gsp
