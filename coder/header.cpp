#include "coder/header.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <span>
#include <string>

#include "mesh/error.h"

namespace gsp {

namespace {

constexpr std::array<std::uint8_t, 3> kMagic = {'P', 'G', 'C'};
constexpr std::size_t kChecksumBegin = kMagic.size() + 1, kChecksumEnd = kChecksumBegin + 4;
constexpr std::uint8_t kOldestVersion = 6, kSteadyVersion = 8, kCreaseVersion = 8, kByAreaVersion = 9,
                       kCarriedVersion = 10;
/// In the byte of the wavelet: creases follow the base's faces.
constexpr int kCreased = 8;
/// Sums of it and a control point's steps are exact in double precision, multiplied by a grid of 3 bits too.
constexpr std::int64_t kMostControlOrigin = std::int64_t{1} << 41;

[[noreturn]] void refuse(const std::string& why) { throw Error(Cause::BadStream, "not a usable coded mesh: " + why); }

/// CRC-32 of IEEE 802.3, bit by bit, of the header from its size on: headers are short. From version 7 on the version
/// comes before it, since any other that is read would be taken for this one.
std::uint32_t checksum(const std::uint8_t* begin, const std::uint8_t* end) {
  std::uint32_t crc = ~0u;
  const auto add = [&](std::uint8_t byte) {
    crc ^= byte;
    for (int b = 0; b < 8; ++b) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  };
  if (const std::uint8_t version = begin[kMagic.size()]; version > kOldestVersion) add(version);
  std::for_each(begin + kChecksumEnd, end, add);
  return ~crc;
}

void put_varint(Bytes& out, std::uint64_t value) {
  for (; value >= 128; value >>= 7) out.push_back(static_cast<std::uint8_t>(value | 128));
  out.push_back(static_cast<std::uint8_t>(value));
}

std::uint64_t zigzag(std::int64_t value) {
  return (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
}
std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1) ^ -static_cast<std::int64_t>(value & 1);
}

class Parser {
 public:
  Parser(const std::uint8_t* begin, const std::uint8_t* end) : next_(begin), end_(end) {}
  std::uint8_t byte() {
    if (next_ == end_) refuse("the header ends early");
    return *next_++;
  }
  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (int shift = 0; shift < 63; shift += 7) {
      const std::uint64_t b = byte();
      value |= (b & 127) << shift;
      if (b < 128) return value;
    }
    refuse("a number is too long");
  }
  std::int64_t signed_within(std::int64_t limit) {
    const std::int64_t value = unzigzag(varint());
    if (value < -limit || value > limit) refuse("a number is out of range");
    return value;
  }
  int byte_within(int limit) {
    const int value = byte();
    if (value > limit) refuse("a field is out of range");
    return value;
  }
  const std::uint8_t* next() const { return next_; }
  std::span<const std::uint8_t> bytes(std::uint64_t count) {
    if (count > static_cast<std::uint64_t>(end_ - next_)) refuse("the header ends early");
    next_ += count;
    return {next_ - count, next_};
  }

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

/// Past the magic and the checksum: the size of the rest.
std::uint64_t size_of_rest(Parser& parser) {
  for (std::uint8_t expected : kMagic)
    if (parser.byte() != expected) refuse("it does not start with 'PGC'");
  const int version = parser.byte();
  if (version < kOldestVersion || version > kStreamVersion)
    refuse("its version is " + std::to_string(version) + ", not " + std::to_string(kOldestVersion) + " to " +
           std::to_string(kStreamVersion));
  for (int b = 0; b < 4; ++b) parser.byte();
  const std::uint64_t size = parser.varint();
  if (size > static_cast<std::uint64_t>(kMaxDecodedFaces)) refuse("the header is too large");
  return size;
}

void put_control(Bytes& rest, const StreamHeader& header) {
  int exponent = 0;
  const int mantissa = static_cast<int>(8.0 * std::frexp(header.control_grid, &exponent));
  put_varint(rest, zigzag(4 * exponent + mantissa - 4));
  Bytes control;
  encode_control(header.base, header.base_planes, header.control, control);
  put_varint(rest, control.size());
  rest.insert(rest.end(), control.begin(), control.end());
}

/// Reads the grid, and where the control points are.
std::span<const std::uint8_t> control_bytes(Parser& parser, StreamHeader& header) {
  if (header.base_planes > kMostControlPlanes) refuse("a field is out of range");
  for (std::int64_t o : header.origin)
    if (std::abs(o) > kMostControlOrigin) refuse("a field is out of range");
  const int grid = static_cast<int>(parser.signed_within(4 * 500 + 3));
  header.control_grid = std::ldexp(4 + (grid & 3), (grid >> 2) - 3);
  return parser.bytes(parser.varint());
}

}  // namespace

int finest_level(const StreamHeader& header, std::int64_t faces) {
  return last_level_with(static_cast<std::int64_t>(header.base.faces.size()), faces, header.level);
}

int importance_level(const StreamHeader& header) { return finest_level(header, kFreeFaces); }

Bytes write_header(const StreamHeader& header, const Bytes& connectivity) {
  Bytes rest;
  int ratio_exponent = 0;
  while (1 << ratio_exponent < header.tangential_ratio) ++ratio_exponent;
  rest.push_back(static_cast<std::uint8_t>(static_cast<int>(header.wavelet) |
                                           (header.base.creases.empty() ? 0 : kCreased) | ratio_exponent << 4 |
                                           static_cast<int>(header.kind) << 6));
  rest.push_back(static_cast<std::uint8_t>(header.level));
  rest.push_back(static_cast<std::uint8_t>(header.base_planes));
  rest.push_back(static_cast<std::uint8_t>(header.detail_planes));
  put_varint(rest, header.base.faces.size());
  put_varint(rest, zigzag(header.step_exponent));
  for (std::int64_t o : header.origin) put_varint(rest, zigzag(o));
  if (header.kind == StreamKind::Displaced) put_control(rest, header);
  rest.insert(rest.end(), connectivity.begin(), connectivity.end());

  Bytes sized;
  put_varint(sized, rest.size());
  sized.insert(sized.end(), rest.begin(), rest.end());
  Bytes bytes(kChecksumEnd + sized.size());
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  bytes[kMagic.size()] = header.kind == StreamKind::Displaced ? kCarriedVersion : kByAreaVersion;
  std::copy(sized.begin(), sized.end(), bytes.begin() + kChecksumEnd);
  seal_header(bytes);
  return bytes;
}

void seal_header(Bytes& stream) {
  const std::size_t size = header_size(stream.data(), stream.data() + stream.size());
  if (size > stream.size()) refuse("the header ends early");
  const std::uint32_t crc = checksum(stream.data(), stream.data() + size);
  for (int b = 0; b < 4; ++b) stream[kChecksumBegin + b] = static_cast<std::uint8_t>(crc >> (8 * b));
}

std::size_t header_size(const std::uint8_t* begin, const std::uint8_t* end) {
  Parser parser(begin, end);
  const std::uint64_t rest = size_of_rest(parser);
  return static_cast<std::size_t>(parser.next() - begin) + rest;
}

StreamHeader read_header(const std::uint8_t* begin, const std::uint8_t* end) {
  const std::size_t size = header_size(begin, end);
  if (size > static_cast<std::size_t>(end - begin)) refuse("the header ends early");
  end = begin + size;
  std::uint32_t stored = 0;
  for (int b = 0; b < 4; ++b) stored |= static_cast<std::uint32_t>(begin[kChecksumBegin + b]) << (8 * b);
  if (checksum(begin, end) != stored) refuse("the header's checksum is wrong");

  Parser parser(begin, end);
  size_of_rest(parser);
  StreamHeader header;
  if (begin[kMagic.size()] < kByAreaVersion) header.frames = FrameRule::Steady;
  if (begin[kMagic.size()] < kSteadyVersion) header.frames = FrameRule::Mean;
  if (begin[kMagic.size()] < kCarriedVersion) header.across = AcrossRule::AtBoundary;
  const int transform = parser.byte();
  const bool creased = begin[kMagic.size()] >= kCreaseVersion && (transform & kCreased) != 0;
  const int wavelet = (transform & 15) - (creased ? kCreased : 0);
  if (wavelet >= static_cast<int>(std::size(kWavelets))) refuse("its wavelet is unknown");
  header.wavelet = static_cast<Wavelet>(wavelet);
  header.tangential_ratio = 1 << (transform >> 4 & 3);
  if (transform >> 6 >= kStreamKinds) refuse("its kind is unknown");
  header.kind = static_cast<StreamKind>(transform >> 6);
  header.level = parser.byte_within(kMaxSubdivisionLevel);
  header.base_planes = parser.byte_within(31);
  header.detail_planes = parser.byte_within(31);
  const std::uint64_t faces = parser.varint();
  if (faces == 0 || faces > static_cast<std::uint64_t>(kMaxDecodedFaces >> (2 * header.level)))
    refuse("its mesh has no faces or too many");
  header.step_exponent = static_cast<int>(parser.signed_within(500));
  for (std::int64_t& o : header.origin) o = parser.signed_within(std::int64_t{1} << 58);
  std::span<const std::uint8_t> control;
  if (header.kind == StreamKind::Displaced) control = control_bytes(parser, header);
  header.base = decode_connectivity(static_cast<int>(faces), creased, parser.next(), end);
  if (header.kind == StreamKind::Displaced)
    header.control = decode_control(header.base, header.base_planes, control.data(), control.data() + control.size());
  return header;
}

}  // namespace gsp
