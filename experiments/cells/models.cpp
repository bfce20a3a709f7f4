#include "experiments/cells/models.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "experiments/cells/suggest.h"
#include "mesh/error.h"
#include "mesh/shapes.h"

namespace gsp {

namespace {

namespace fs = std::filesystem;

constexpr const char* kShapePrefix = "shape:";

struct Shape {
  const char* name;
  Mesh (*make)();
};

constexpr Shape kShapes[] = {
    {"sphere", [] { return shapes::sphere(4); }},
    {"bumpy-sphere", [] { return shapes::bumpy_sphere(4); }},
    {"torus", [] { return shapes::torus(48, 24); }},
    {"genus-2", [] { return shapes::genus_slab(2, 2); }},
    {"dish",
     [] {
       Mesh dish = shapes::sector_disc(5, 4);
       for (Vec3& p : dish.positions) p.z() = 0.4 * p.head<2>().squaredNorm() * (1.0 + 0.3 * p.x());
       return dish;
     }},
};

bool surface_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".ply" || ending == ".obj" || ending == ".off" || ending == ".stl";
}

bool is_shape(const std::string& source) { return source.rfind(kShapePrefix, 0) == 0; }

const Shape& shape_of(const std::string& source) {
  const std::string name = source.substr(std::string(kShapePrefix).size());
  for (const Shape& shape : kShapes)
    if (name == shape.name) return shape;
  const std::string nearest = nearest_word(name, shape_names());
  throw Error(Cause::BadOption,
              fmt::format("no shape is called {}; {}", name,
                          nearest.empty() ? fmt::format("there are {}", fmt::join(shape_names(), ", "))
                                          : "did you mean " + nearest + "?"));
}

}  // namespace

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const Shape& shape : kShapes) names.emplace_back(shape.name);
  return names;
}

std::vector<std::string> surface_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!fs::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path))
      if (entry.is_regular_file() && surface_ending(entry.path())) inside.push_back(entry.path().string());
    if (inside.empty()) throw Error(Cause::CannotOpen, "no PLY, OBJ, OFF or STL file in " + path);
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return files;
}

std::vector<ModelSource> named_models(const std::vector<std::string>& sources) {
  std::vector<ModelSource> models;
  std::map<std::string, int> uses;
  for (const std::string& source : sources) {
    const std::string name = is_shape(source) ? shape_of(source).name : fs::path(source).stem().string();
    const int use = ++uses[name];
    models.push_back({use == 1 ? name : fmt::format("{}-{}", name, use), source});
  }
  return models;
}

std::vector<std::string> matching_models(const std::string& pattern) {
  if (is_shape(pattern)) {
    shape_of(pattern);
    return {pattern};
  }
  glob_t found{};
  const int status = ::glob(pattern.c_str(), 0, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (status != 0) throw Error(Cause::CannotOpen, "no file matches " + pattern);
  return surface_files(paths);
}

SurfaceFile read_model(const std::string& source, const ReadOptions& options) {
  if (!is_shape(source)) return read_surface(source, options);
  return {shape_of(source).make(), {}, {}};
}

}  // namespace gsp
