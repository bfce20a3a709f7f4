#include <cstring>
#include <string>
#include <vector>

#include "mesh/files/formats.h"
#include "mesh/files/polygon_builder.h"
#include "mesh/files/text_scanner.h"
#include "mesh/read_file.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

/// What the keyword says of the numbers behind a vertex's position.
struct Keyword {
  bool normals = false, colours = false, texture = false;
  bool any() const { return normals || colours || texture; }
};

/// Steps over the keyword [ST][C][N][4][n]OFF. It may be missing, and some writers put no space after it.
Keyword parse_keyword(TextScanner& text) {
  const std::string_view token = text.next();
  if (token.empty()) text.fail(Cause::Truncated, "the OFF file is empty");
  const std::size_t end = token.find("OFF");
  if (end == std::string_view::npos) {
    text.put_back(token.size());
    return {};
  }
  const std::string_view prefix = token.substr(0, end);
  if (prefix.find_first_not_of("STCN") != std::string_view::npos)
    text.fail(Cause::UnknownFormat, prefix.find_first_not_of("STCN4n") == std::string_view::npos
                                        ? "OFF files of dimension other than 3 are not supported"
                                        : quoted(token) + " is no OFF keyword");
  text.put_back(token.size() - end - 3);
  const auto has = [&](char c) { return prefix.find(c) != std::string_view::npos; };
  return {has('N'), has('C'), has('S')};
}

std::size_t parse_count(TextScanner& text, const char* what, std::size_t bytes_each) {
  const long long count = text.integer();
  if (count < 0) text.fail(Cause::Malformed, std::string("the OFF header has a negative number of ") + what);
  if (static_cast<std::size_t>(count) > (text.left() + 1) / bytes_each)
    text.fail(Cause::Truncated,
              "the OFF header promises " + std::to_string(count) + " " + what + ", more than the file can hold");
  return static_cast<std::size_t>(count);
}

void parse_counts(TextScanner& text, std::size_t& vertices, std::size_t& faces) {
  if (const std::string_view word = text.next(); word == "BINARY")
    text.fail(Cause::UnknownFormat, "binary OFF files are not supported");
  else
    text.put_back(word.size());
  vertices = parse_count(text, "vertices", std::strlen("0 0 0\n"));
  faces = parse_count(text, "faces", std::strlen("0\n"));
  // The number of edges may be missing, and nobody keeps it right.
  if (text.numbers_to_line_end() > 1) text.fail(Cause::Malformed, "the OFF header has more than three counts");
  require_countable(vertices, faces);
}

/// Normals, colours (1, 3 or 4 numbers) and texture coordinates as the keyword has them. Many writers put a colour
/// behind the vertices of a plain OFF.
void skip_attributes(TextScanner& text, const Keyword& keyword) {
  const int extra = text.numbers_to_line_end();
  const int fixed = 3 * keyword.normals + 2 * keyword.texture, colour = extra - fixed;
  const bool may_have_colour = keyword.colours || !keyword.any();
  if (extra == 0 || colour == 0 || (may_have_colour && (colour == 3 || colour == 4))) return;
  if (keyword.colours && colour == 1) return;
  text.fail(Cause::Malformed, std::to_string(extra) +
                                  " numbers follow a position: neither a colour nor what the OFF "
                                  "keyword announces");
}

void parse_face(TextScanner& text, std::vector<long long>& corners) {
  const long long count = text.integer();
  if (count < 0) text.fail(Cause::Malformed, "an OFF face has a negative number of corners");
  corners.clear();
  for (long long k = 0; k < count; ++k) corners.push_back(text.integer());
  if (const int colour = text.numbers_to_line_end(); colour == 2 || colour > 4)
    text.fail(Cause::Malformed,
              std::to_string(colour) + " numbers follow the corners of an OFF face; a colour has 1, 3 or 4");
}

}  // namespace

SurfaceFile parse_off(std::string_view bytes) {
  TextScanner text(without_byte_order_mark(bytes), '#');
  const Keyword keyword = parse_keyword(text);
  std::size_t vertices, faces;
  parse_counts(text, vertices, faces);
  SurfaceFile file;
  file.mesh.positions.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double x = text.number(), y = text.number(), z = text.number();
    file.mesh.positions.emplace_back(x, y, z);
    skip_attributes(text, keyword);
  }
  file.mesh.faces.reserve(faces);
  PolygonBuilder polygons(file);
  std::vector<long long> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    parse_face(text, corners);
    polygons.add(corners);
  }
  polygons.finish();
  text.require_end("the OFF file should end after the " + std::to_string(faces) + " faces that its header counts");
  return file;
}

}  // namespace gsp
