#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "mesh/files/formats.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read_file.h"
#include "mesh/topology.h"
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

/// The first word alone does not tell: many writers of binary files begin their header with "solid". Text has no zeros.
bool is_ascii(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes) return true;
  if (promised_bytes(bytes) == bytes.size() || bytes.substr(0, kHeaderBytes).find('\0') != std::string_view::npos)
    return false;
  TextScanner text(without_byte_order_mark(bytes));
  return equals_ignoring_case(text.next(), "solid");
}

void add_triangle(Mesh& soup) {
  const int last = soup.vertex_count() - 1;
  soup.faces.push_back({last - 2, last - 1, last});
}

/// A rest that is too short for a facet is padding; `notes` receives what it was.
void check_size(std::string_view bytes, std::size_t count, std::vector<std::string>& notes) {
  const std::size_t promised = promised_bytes(bytes);
  if (promised > bytes.size())
    throw Error(Cause::Truncated, "the STL header promises more facets than the file holds", Element::Byte,
                static_cast<long long>(bytes.size()));
  const std::size_t rest = bytes.size() - promised;
  if (rest >= kFacetBytes)
    throw Error(Cause::Malformed,
                "the STL header counts " + std::to_string(count) + " facets, but " + std::to_string(rest) +
                    " bytes follow them, which hold " + std::to_string(rest / kFacetBytes) + " more",
                Element::Byte, static_cast<long long>(promised));
  if (rest > 0) notes.push_back(std::to_string(rest) + " bytes behind the last STL facet are not read");
}

Mesh parse_binary(std::string_view bytes, std::vector<std::string>& notes) {
  const std::size_t count = read_uint32(bytes, kHeaderBytes - 4);
  check_size(bytes, count, notes);
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
  std::string_view token = text.next();
  for (int k = 0; k < 3 && !equals_ignoring_case(token, "outer"); ++k) token = text.next();
  text.put_back(token.size());
  expect(text, "outer");
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
  TextScanner text(without_byte_order_mark(bytes));
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

SurfaceFile parse_stl(std::string_view bytes) {
  SurfaceFile file;
  const Mesh soup = is_ascii(bytes) ? parse_ascii(bytes) : parse_binary(bytes, file.notes);
  WeldedMesh welded = weld(soup, first_at_same_position(soup.positions));
  file.mesh = std::move(welded.mesh);
  file.numbering.vertices = std::move(welded.vertices);
  return file;
}

}  // namespace gsp
