#include "mesh/files/formats.h"

#include <algorithm>
#include <cctype>

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

SurfaceFile parse_surface(MeshFormat format, std::string_view bytes) {
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

}  // namespace gsp
