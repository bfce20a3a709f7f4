#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>

#include "mesh/formats.h"
#include "mesh/text_scanner.h"
#include "mesh/weld.h"

namespace gsp {

namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;
constexpr std::size_t kNormalBytes = 12;

bool equals_ignoring_case(std::string_view token, std::string_view word) {
  return std::equal(token.begin(), token.end(), word.begin(), word.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

std::uint32_t read_uint32(std::string_view bytes, std::size_t at) {
  std::uint32_t value;
  static_assert(std::endian::native == std::endian::little, "STL is little-endian");
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

std::size_t promised_bytes(std::string_view bytes) {
  return kHeaderBytes + kFacetBytes * static_cast<std::size_t>(read_uint32(bytes, kHeaderBytes - 4));
}

/// The first word alone does not tell: many writers of binary files begin their header with "solid".
bool is_ascii(std::string_view bytes) {
  if (bytes.size() >= kHeaderBytes && promised_bytes(bytes) == bytes.size()) return false;
  TextScanner text(bytes);
  return bytes.size() < kHeaderBytes || equals_ignoring_case(text.next(), "solid");
}

void add_triangle(Mesh& soup) {
  const int last = soup.vertex_count() - 1;
  soup.faces.push_back({last - 2, last - 1, last});
}

Mesh parse_binary(std::string_view bytes) {
  if (promised_bytes(bytes) > bytes.size())
    throw Error(Cause::Truncated, "the STL header promises more facets than the file holds", Element::Byte,
                static_cast<long long>(bytes.size()));
  const std::size_t count = read_uint32(bytes, kHeaderBytes - 4);
  require_countable(3 * count, count);
  Mesh soup;
  soup.positions.reserve(3 * count);
  soup.faces.reserve(count);
  for (std::size_t f = 0; f < count; ++f) {
    std::size_t at = kHeaderBytes + kFacetBytes * f + kNormalBytes;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (int k = 0; k < 3; ++k, at += 4) p[k] = std::bit_cast<float>(read_uint32(bytes, at));
      soup.positions.push_back(p);
    }
    add_triangle(soup);
  }
  return soup;
}

void expect(TextScanner& text, std::string_view word) {
  const std::string_view token = text.next();
  if (token.empty()) text.fail(Cause::Truncated, "the STL file ends within a facet");
  if (!equals_ignoring_case(token, word)) text.fail(Cause::Malformed, "\"" + std::string(word) + "\" should be here");
}

/// What follows the word "facet".
void parse_facet(TextScanner& text, Mesh& soup) {
  expect(text, "normal");
  // Normals are recomputed from the corners, and some writers print none or garbage for degenerate facets.
  while (!equals_ignoring_case(text.next(), "outer"))
    if (text.at_end()) text.fail(Cause::Truncated, "the STL file ends within a facet");
  expect(text, "loop");
  for (int corner = 0; corner < 3; ++corner) {
    expect(text, "vertex");
    const double x = text.number(), y = text.number(), z = text.number();
    soup.positions.emplace_back(x, y, z);
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  add_triangle(soup);
}

Mesh parse_ascii(std::string_view bytes) {
  Mesh soup;
  TextScanner text(bytes);
  bool inside = false;
  while (!text.at_end()) {
    const std::string_view token = text.next();
    if (!inside && equals_ignoring_case(token, "solid")) {
      inside = true;
      text.skip_line();
    } else if (inside && equals_ignoring_case(token, "endsolid")) {
      inside = false;
      text.skip_line();
    } else if (inside && equals_ignoring_case(token, "facet")) {
      parse_facet(text, soup);
      require_countable(soup.positions.size(), soup.faces.size());
    } else {
      text.fail(Cause::Malformed, inside ? "\"facet\" or \"endsolid\" should be here" : "\"solid\" should be here");
    }
  }
  if (inside || bytes.empty()) text.fail(Cause::Truncated, "the STL file ends without \"endsolid\"");
  return soup;
}

}  // namespace

Mesh parse_stl(std::string_view bytes) { return weld(is_ascii(bytes) ? parse_ascii(bytes) : parse_binary(bytes)); }

}  // namespace gsp
