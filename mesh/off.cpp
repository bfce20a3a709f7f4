#include <cstring>
#include <string>
#include <vector>

#include "mesh/formats.h"
#include "mesh/text_scanner.h"

namespace gsp {

namespace {

/// Steps over the keyword [ST][C][N][4][n]OFF. It may be missing, and some writers put no space after it.
void skip_keyword(TextScanner& text) {
  const std::string_view token = text.next();
  if (token.empty()) text.fail(Cause::Truncated, "the OFF file is empty");
  const std::size_t end = token.find("OFF");
  if (end == std::string_view::npos) {
    text.put_back(token.size());
    return;
  }
  const std::string_view prefix = token.substr(0, end);
  if (prefix.find_first_not_of("STCN") != std::string_view::npos)
    text.fail(Cause::UnknownFormat, "OFF files of dimension other than 3 are not supported");
  text.put_back(token.size() - end - 3);
}

std::size_t parse_count(TextScanner& text, const char* what, std::size_t bytes_each) {
  const long long count = text.integer();
  if (count < 0) text.fail(Cause::Malformed, std::string("the OFF header has a negative number of ") + what);
  if (static_cast<std::size_t>(count) > (text.left() + 1) / bytes_each)
    text.fail(Cause::Truncated,
              "the OFF header promises " + std::to_string(count) + " " + what + ", more than the file can hold");
  return static_cast<std::size_t>(count);
}

}  // namespace

Mesh parse_off(std::string_view bytes) {
  TextScanner text(bytes, '#');
  skip_keyword(text);
  if (const std::string_view word = text.next(); word == "BINARY")
    text.fail(Cause::UnknownFormat, "binary OFF files are not supported");
  else
    text.put_back(word.size());
  const std::size_t vertices = parse_count(text, "vertices", std::strlen("0 0 0\n"));
  const std::size_t faces = parse_count(text, "faces", std::strlen("0\n"));
  text.skip_line();  // the number of edges, which nobody keeps right

  require_countable(vertices, faces);
  Mesh mesh;
  mesh.positions.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const double x = text.number(), y = text.number(), z = text.number();
    mesh.positions.emplace_back(x, y, z);
    text.skip_line();  // normals, colours, texture coordinates
  }
  mesh.faces.reserve(faces);
  FanBuilder fans(mesh);
  std::vector<long long> corners;
  for (std::size_t f = 0; f < faces; ++f) {
    const long long count = text.integer();
    if (count < 0) text.fail(Cause::Malformed, "an OFF face has a negative number of corners");
    corners.clear();
    for (long long k = 0; k < count; ++k) corners.push_back(text.integer());
    fans.add(corners);
    text.skip_line();  // colours
  }
  return mesh;
}

}  // namespace gsp
