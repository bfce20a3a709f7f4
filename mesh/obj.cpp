#include <string>
#include <vector>

#include "mesh/formats.h"
#include "mesh/text_scanner.h"

namespace gsp {

namespace {

/// The rest of the line's tokens; a backslash at the line's end joins the next line to it.
std::string_view next_in_statement(TextScanner& text) {
  std::string_view token = text.next_in_line();
  while (token == "\\") {
    text.skip_line();
    token = text.next_in_line();
  }
  if (token.size() > 1 && token.back() == '\\') {
    text.put_back(1);
    token.remove_suffix(1);
  }
  return token;
}

Vec3 parse_position(TextScanner& text) {
  Vec3 p;
  for (int k = 0; k < 3; ++k)
    if (!parse_number(next_in_statement(text), p[k])) text.fail(Cause::Malformed, "an OBJ vertex needs three numbers");
  return p;
}

}  // namespace

Mesh parse_obj(std::string_view bytes) {
  Mesh mesh;
  // Flat lists until the end, since a face may name a vertex that comes later in the file.
  std::vector<long long> corners;
  std::vector<std::size_t> ends;
  TextScanner text(bytes, '#');
  while (!text.at_end()) {
    const std::string_view keyword = text.next_in_line();
    if (keyword == "v") {
      mesh.positions.push_back(parse_position(text));
    } else if (keyword == "f") {
      for (std::string_view token = next_in_statement(text); !token.empty(); token = next_in_statement(text)) {
        long long index;
        if (!parse_integer(token.substr(0, token.find('/')), index))
          text.fail(Cause::Malformed, "an OBJ face names its vertices by whole numbers");
        corners.push_back(index < 0 ? static_cast<long long>(mesh.positions.size()) + index : index - 1);
      }
      ends.push_back(corners.size());
    } else {
      while (!next_in_statement(text).empty()) continue;
    }
  }
  require_countable(mesh.positions.size(), ends.size());
  FanBuilder fans(mesh);
  std::size_t begin = 0;
  for (std::size_t end : ends) {
    fans.add(std::span<const long long>(corners).subspan(begin, end - begin));
    begin = end;
  }
  return mesh;
}

}  // namespace gsp
