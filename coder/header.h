#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "coder/base_connectivity.h"
#include "coder/codec.h"

namespace gsp {

/// How many numbers of a vertex above the base a stream holds. Values, at most 3, are those on disk.
enum class StreamKind : std::uint8_t {
  Parametric = 0,  ///< three
  Normal = 1,      ///< one, along the normal of its edge's frame; three on the boundary
};
inline constexpr int kStreamKinds = 2;

/// The version that is written. Those of the one before, all parametric, are read in the same way.
inline constexpr std::uint8_t kStreamVersion = 7;

/// Everything that a decoder needs before the first bit-plane. On disk (`*.pgc`):
///
///     "PGC"  version  CRC-32 of version and rest (little endian)  varint size of the rest
///     rest: wavelet | log2(tangential ratio) << 4 | kind << 6, level, base planes, detail planes (one byte each);
///           varints: base faces, zigzag step exponent, zigzag origin x, y, z; base connectivity
///
/// A varint holds 7 bits a byte, least significant first, at most 9 bytes.
struct StreamHeader {
  StreamKind kind = StreamKind::Parametric;
  Wavelet wavelet = Wavelet::Loop;
  int tangential_ratio = 4;
  int level = 0;
  int base_planes = 0;
  int detail_planes = 0;
  int step_exponent = 0;                    ///< the step of normal details of the finest level is 2^step_exponent
  std::array<std::int64_t, 3> origin = {};  ///< of the base positions, in units of 2^(base_planes - 3) base steps
  CodedBase base;
};

/// The largest decoded mesh, in faces of its finest level: bounds memory and time against hostile headers.
inline constexpr std::int64_t kMaxDecodedFaces = 50'000'000;

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
