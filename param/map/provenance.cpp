#include <charconv>
#include <string_view>

#include "param/map/parameterization.h"

namespace gsp {

namespace {

int number_of(const Parameterization& map, std::string_view key, int otherwise) {
  for (const std::string_view line : map.provenance) {
    if (line.substr(0, key.size()) != key) continue;
    const std::string_view digits = line.substr(key.size());
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc() && end == digits.data() + digits.size() && value > 0 && value <= otherwise) return value;
  }
  return otherwise;
}

}  // namespace

int input_vertex_count(const Parameterization& map) {
  return number_of(map, "input_vertices ", map.surface.vertex_count());
}

int input_face_count(const Parameterization& map) { return number_of(map, "input_faces ", map.surface.face_count()); }

}  // namespace gsp
