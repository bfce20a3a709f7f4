#include "mesh/formats.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "mesh/error.h"

namespace gsp {

std::optional<MeshFormat> format_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./\\");
  if (dot == std::string::npos || path[dot] != '.') return std::nullopt;
  std::string ending = path.substr(dot + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == "ply") return MeshFormat::Ply;
  if (ending == "obj") return MeshFormat::Obj;
  if (ending == "off") return MeshFormat::Off;
  if (ending == "stl") return MeshFormat::Stl;
  return std::nullopt;
}

Mesh parse_mesh(MeshFormat format, std::string_view bytes) {
  switch (format) {
    case MeshFormat::Ply:
      return parse_ply_mesh(bytes);
    case MeshFormat::Obj:
      return parse_obj(bytes);
    case MeshFormat::Off:
      return parse_off(bytes);
    case MeshFormat::Stl:
      return parse_stl(bytes);
  }
  throw Error(Cause::Internal, "a mesh format without a parser");
}

void FanBuilder::add(std::span<const long long> corners) {
  const long long count = mesh_.vertex_count();
  for (long long corner : corners)
    if (corner < 0 || corner >= count)
      throw Error(Cause::IndexOutOfRange,
                  "a face names vertex " + std::to_string(corner) + ", but there are " + std::to_string(count),
                  Element::Face, polygon_);
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh_.faces.push_back(
        {static_cast<int>(corners[0]), static_cast<int>(corners[k - 1]), static_cast<int>(corners[k])});
  require_countable(mesh_.positions.size(), mesh_.faces.size());
  ++polygon_;
}

void require_countable(std::size_t vertices, std::size_t faces) {
  constexpr std::size_t limit = std::numeric_limits<int>::max();
  if (vertices > limit || faces > limit / 3)
    throw Error(Cause::Malformed, "more vertices or faces than can be numbered");
}

}  // namespace gsp
