#include "experiments/figures/picture.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "experiments/figures/map_measures.h"
#include "experiments/figures/paint.h"
#include "experiments/figures/remesh_map.h"
#include "mesh/files/formats.h"
#include "mesh/io.h"
#include "mesh/ply.h"
#include "mesh/topology.h"
#include "metrics/surface_distance.h"
#include "param/map/param_file.h"
#include "remesh/semiregular_file.h"

namespace gsp {

namespace {

Picture draw(const Mesh& mesh, const Camera& camera, const Paint& paint, const RenderOptions& options,
             std::optional<ColourScale> scale = {}) {
  return {render(mesh, camera, paint, options), scale};
}

/// Red from the distance on that 95% of the vertices are nearer than.
Picture distance_picture(const Mesh& mesh, const Camera& camera, const PictureOptions& options) {
  if (options.other.empty()) throw Error(Cause::BadOption, "a picture of distance needs the surface to measure to");
  std::vector<double> distances = vertex_distances(mesh, SurfaceTree(read_surface(options.other, options.read).mesh));
  std::vector<double> sorted = distances;
  const auto p95 = sorted.begin() + static_cast<std::ptrdiff_t>(0.95 * (sorted.size() - 1));
  std::nth_element(sorted.begin(), p95, sorted.end());
  const ColourScale scale = {0.0, *p95};
  return draw(mesh, camera, vertex_value_paint(mesh, std::move(distances), scale), options.render, scale);
}

Picture measure_picture(const Parameterization& map, const Camera& camera, const PictureOptions& options) {
  const std::string name = options.subject == Subject::Smoothness ? "smoothness" : options.measure;
  for (MapMeasure& measure : map_measures(map, distortion(map), smoothness(map)))
    if (measure.column.name == name) {
      const Paint paint = with_patch_edges(face_value_paint(std::move(measure.column.values), measure.scale), map);
      return draw(map.surface, camera, paint, options.render, measure.scale);
    }
  throw Error(Cause::BadOption, "unknown measure " + name);
}

/// Every edge of the mesh, and over them those that `lines` adds.
Picture wireframe_picture(const Mesh& mesh, const Camera& camera, RenderOptions options,
                          const std::function<Paint(Paint)>& lines) {
  options.smooth = false;
  return draw(mesh, camera, lines(with_wireframe(plain_paint())), options);
}

Picture remesh_picture(const Parameterization& map, const Camera& camera, const PictureOptions& options,
                       Progress& progress) {
  const Parameterization remeshed = remesh_as_map(remesh(map, options.remesh, progress));
  return wireframe_picture(remeshed.surface, camera, options.render, [&](Paint under) {
    return with_creases(with_patch_edges(std::move(under), remeshed), remeshed);
  });
}

/// Of a map or a semi-regular mesh.
Parameterization read_map(const std::string& path) {
  const bool is_map = format_of(path) == MeshFormat::Ply && read_ply(path).find("base_face") != nullptr;
  return is_map ? read_parameterization(path) : remesh_as_map(read_semiregular(path));
}

/// Whether a surface's file says of itself that it is a map or a semi-regular mesh, and has creases.
bool has_creases(const std::string& path) {
  if (format_of(path) != MeshFormat::Ply) return false;
  const PlyDocument document = read_ply(path);
  const PlyElement* creases = document.find("crease");
  if (creases == nullptr || creases->count == 0) return false;
  const std::vector<std::string>& comments = document.comments;
  return document.find("base_face") != nullptr ||
         std::find(comments.begin(), comments.end(), kSemiregularSignature) != comments.end();
}

bool needs_map(Subject subject) {
  return subject != Subject::Wireframe && subject != Subject::Surface && subject != Subject::Distance;
}

}  // namespace

const char* subject_name(Subject subject) {
  switch (subject) {
    case Subject::Patches:
      return "patches";
    case Subject::Isolines:
      return "isolines";
    case Subject::Distortion:
      return "distortion";
    case Subject::Smoothness:
      return "smoothness";
    case Subject::Remesh:
      return "remesh";
    case Subject::Wireframe:
      return "wireframe";
    case Subject::Surface:
      return "surface";
    case Subject::Distance:
      return "distance";
  }
  throw Error(Cause::Internal, "unknown subject of a picture");
}

Picture map_picture(const Parameterization& map, const PictureOptions& options, Progress& progress) {
  require_finite_surface(map.surface);
  const Camera camera = make_camera(map.surface, options.view);
  switch (options.subject) {
    case Subject::Patches:
      return draw(map.surface, camera, with_creases(with_patch_edges(patch_paint(map), map), map), options.render);
    case Subject::Isolines:
      return draw(map.surface, camera, with_patch_edges(with_isolines(plain_paint(), map, options.density), map),
                  options.render);
    case Subject::Distortion:
    case Subject::Smoothness:
      return measure_picture(map, camera, options);
    case Subject::Remesh:
      return remesh_picture(map, camera, options, progress);
    case Subject::Wireframe:
      return wireframe_picture(map.surface, camera, options.render,
                               [&](Paint under) { return with_creases(std::move(under), map); });
    default:
      return mesh_picture(map.surface, options);
  }
}

Picture mesh_picture(const Mesh& mesh, const PictureOptions& options) {
  require_finite_surface(mesh);
  const Camera camera = make_camera(mesh, options.view);
  switch (options.subject) {
    case Subject::Wireframe:
      return wireframe_picture(mesh, camera, options.render, [](Paint under) { return under; });
    case Subject::Surface:
      return draw(mesh, camera, plain_paint(), options.render);
    case Subject::Distance:
      return distance_picture(mesh, camera, options);
    default:
      throw Error(Cause::BadOption, std::string("a picture of ") + subject_name(options.subject) + " needs a map");
  }
}

Picture file_picture(const std::string& path, const PictureOptions& options, Progress& progress) {
  progress.report("read", 0.0);
  if (!needs_map(options.subject)) {
    const Mesh mesh = read_surface(path, options.read).mesh;
    // A weld or repair makes another surface, which the map does not know.
    const bool as_read = !options.read.weld && options.read.repair == Repair::None;
    if (options.subject != Subject::Wireframe || !as_read || !has_creases(path)) {
      progress.report("draw", 0.2);
      return mesh_picture(mesh, options);
    }
  }
  const Parameterization map = read_map(path);
  progress.report("draw", 0.2);
  return map_picture(map, options, progress);
}

}  // namespace gsp
