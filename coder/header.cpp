#include "coder/header.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "mesh/error.h"

namespace gsp {

namespace {

constexpr std::array<std::uint8_t, 4> kMagic = {'P', 'G', 'C', 6};
constexpr std::size_t kChecksumEnd = kMagic.size() + 4;

[[noreturn]] void refuse(const std::string& why) { throw Error(Cause::BadStream, "not a usable coded mesh: " + why); }

/// CRC-32 of IEEE 802.3, bit by bit: headers are short.
std::uint32_t crc32(const std::uint8_t* begin, const std::uint8_t* end) {
  std::uint32_t crc = ~0u;
  for (; begin != end; ++begin) {
    crc ^= *begin;
    for (int b = 0; b < 8; ++b) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0u);
  }
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

 private:
  const std::uint8_t* next_;
  const std::uint8_t* end_;
};

/// Past the magic and the checksum: the size of the rest.
std::uint64_t size_of_rest(Parser& parser) {
  for (std::uint8_t expected : kMagic)
    if (parser.byte() != expected) refuse("it does not start with 'PGC' and version 6");
  for (int b = 0; b < 4; ++b) parser.byte();
  const std::uint64_t size = parser.varint();
  if (size > static_cast<std::uint64_t>(kMaxDecodedFaces)) refuse("the header is too large");
  return size;
}

}  // namespace

Bytes write_header(const StreamHeader& header, const Bytes& connectivity) {
  Bytes rest;
  int ratio_exponent = 0;
  while (1 << ratio_exponent < header.tangential_ratio) ++ratio_exponent;
  rest.push_back(static_cast<std::uint8_t>(static_cast<int>(header.wavelet) | ratio_exponent << 4));
  rest.push_back(static_cast<std::uint8_t>(header.level));
  rest.push_back(static_cast<std::uint8_t>(header.base_planes));
  rest.push_back(static_cast<std::uint8_t>(header.detail_planes));
  put_varint(rest, header.base.faces.size());
  put_varint(rest, zigzag(header.step_exponent));
  for (std::int64_t o : header.origin) put_varint(rest, zigzag(o));
  rest.insert(rest.end(), connectivity.begin(), connectivity.end());

  Bytes sized;
  put_varint(sized, rest.size());
  sized.insert(sized.end(), rest.begin(), rest.end());
  Bytes bytes(kChecksumEnd + sized.size());
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  std::copy(sized.begin(), sized.end(), bytes.begin() + kChecksumEnd);
  seal_header(bytes);
  return bytes;
}

void seal_header(Bytes& stream) {
  const std::size_t size = header_size(stream.data(), stream.data() + stream.size());
  if (size > stream.size()) refuse("the header ends early");
  const std::uint32_t crc = crc32(stream.data() + kChecksumEnd, stream.data() + size);
  for (int b = 0; b < 4; ++b) stream[kMagic.size() + b] = static_cast<std::uint8_t>(crc >> (8 * b));
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
  for (int b = 0; b < 4; ++b) stored |= static_cast<std::uint32_t>(begin[kMagic.size() + b]) << (8 * b);
  if (crc32(begin + kChecksumEnd, end) != stored) refuse("the header's checksum is wrong");

  Parser parser(begin, end);
  size_of_rest(parser);
  StreamHeader header;
  const int kinds = parser.byte();
  if ((kinds & 15) >= static_cast<int>(std::size(kWavelets))) refuse("its wavelet is unknown");
  header.wavelet = static_cast<Wavelet>(kinds & 15);
  if (kinds >> 4 > 3) refuse("its tangential ratio is out of range");
  header.tangential_ratio = 1 << (kinds >> 4);
  header.level = parser.byte_within(kMaxSubdivisionLevel);
  header.base_planes = parser.byte_within(31);
  header.detail_planes = parser.byte_within(31);
  const std::uint64_t faces = parser.varint();
  if (faces == 0 || faces > static_cast<std::uint64_t>(kMaxDecodedFaces >> (2 * header.level)))
    refuse("its mesh has no faces or too many");
  header.step_exponent = static_cast<int>(parser.signed_within(500));
  for (std::int64_t& o : header.origin) o = parser.signed_within(std::int64_t{1} << 58);
  header.base = decode_connectivity(static_cast<int>(faces), parser.next(), end);
  return header;
}

}  // namespace gsp
