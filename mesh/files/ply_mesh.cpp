#include <span>
#include <string>
#include <vector>

#include "mesh/error.h"
#include "mesh/files/formats.h"
#include "mesh/files/polygon_builder.h"
#include "mesh/ply.h"
#include "mesh/topology.h"

namespace gsp {

namespace {

const PlyProperty& coordinate(const PlyElement& vertex, const char* name) {
  const PlyProperty* p = vertex.scalar(name);
  if (!p) throw Error(Cause::Malformed, std::string("the PLY vertices have no property ") + name);
  return *p;
}

/// The list of corners, under either of its two customary names.
const PlyProperty* corner_list(const PlyElement& element) {
  const PlyProperty* p = element.list("vertex_indices");
  if (!p) p = element.list("vertex_index");
  if (!p && element.count > 0)
    throw Error(Cause::Malformed, "the PLY element " + element.name + " has no list vertex_indices");
  if (p && p->type >= PlyType::Float32)
    throw Error(Cause::Malformed, "the PLY list " + p->name + " is not of whole numbers");
  return p;
}

/// One strip of triangles, alternately oriented; -1 starts a new strip.
void add_strip(PolygonBuilder& polygons, std::span<const long long> strip) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < strip.size(); ++i) {
    length = strip[i] == -1 ? 0 : length + 1;
    if (length < 3) continue;
    const bool odd = length % 2 == 0;
    const long long triangle[3] = {strip[i - (odd ? 1 : 2)], strip[i - (odd ? 2 : 1)], strip[i]};
    polygons.add(triangle);
  }
}

template <typename Add>
void for_each_row(const PlyElement& element, Add&& add) {
  const PlyProperty* list = corner_list(element);
  if (!list) return;
  std::vector<long long> corners;
  for (std::size_t row = 0; row < element.count; ++row) {
    corners.clear();
    for (std::size_t i = list->starts[row]; i < list->starts[row + 1]; ++i) {
      const double value = list->values[i];
      // An ASCII file may hold larger numbers than its types: they become an index that is out of range.
      corners.push_back(value >= -2147483648.0 && value <= 4294967295.0 ? static_cast<long long>(value) : -2);
    }
    add(std::span<const long long>(corners));
  }
}

}  // namespace

SurfaceFile parse_ply_mesh(std::string_view bytes) {
  const PlyDocument document = parse_ply(bytes);
  const PlyElement* vertex = document.find("vertex");
  if (!vertex) throw Error(Cause::Malformed, "the PLY file has no vertices");
  const std::vector<double>&x = coordinate(*vertex, "x").values, &y = coordinate(*vertex, "y").values,
        &z = coordinate(*vertex, "z").values;
  require_countable(vertex->count, 0);
  SurfaceFile file;
  file.mesh.positions.reserve(vertex->count);
  for (std::size_t v = 0; v < vertex->count; ++v) file.mesh.positions.emplace_back(x[v], y[v], z[v]);

  PolygonBuilder polygons(file);
  if (const PlyElement* face = document.find("face")) {
    file.mesh.faces.reserve(face->count);
    for_each_row(*face, [&](std::span<const long long> corners) { polygons.add(corners); });
  }
  if (const PlyElement* strips = document.find("tristrips"))
    for_each_row(*strips, [&](std::span<const long long> strip) { add_strip(polygons, strip); });
  polygons.finish();
  for (const PlyElement& element : document.elements)
    if (element.count > 0 && element.name != "vertex" && element.name != "face" && element.name != "tristrips")
      file.notes.push_back("the PLY element " + element.name + " of " + std::to_string(element.count) +
                           " rows is not read");
  return file;
}

}  // namespace gsp
