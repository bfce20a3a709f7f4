#include "experiments/cells/models.h"

#include <fmt/format.h>
#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "experiments/cells/suggest.h"
#include "experiments/output/quoting.h"
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

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry->is_regular_file(failed) && surface_ending(entry->path())) files.push_back(entry->path().string());
  if (failed) throw Error(Cause::CannotOpen, "cannot list " + folder + ": " + failed.message());
  if (files.empty()) throw Error(Cause::CannotOpen, "no PLY, OBJ, OFF or STL file in " + folder);
  std::sort(files.begin(), files.end());
  return files;
}

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

bool is_shape(const std::string& source) { return source.rfind(kShapePrefix, 0) == 0; }

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const Shape& shape : kShapes) names.emplace_back(shape.name);
  return names;
}

std::string surface_place(const std::string& source) {
  return is_shape(source) ? source : fs::absolute(source).lexically_normal().string();
}

std::vector<std::string> surface_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  std::set<std::string> places;
  for (const std::string& path : paths)
    for (std::string& file : fs::is_directory(path) ? files_in(path) : std::vector<std::string>{path})
      if (places.insert(surface_place(file)).second) files.push_back(std::move(file));
  return files;
}

std::vector<ModelSource> named_models(const std::vector<std::string>& sources) {
  std::vector<ModelSource> models;
  std::map<std::string, int> uses;
  for (const std::string& source : sources) {
    const std::string name = is_shape(source) ? shape_of(source).name : fs::path(source).stem().string();
    // By how people read it: names that differ in bytes that are no text would look the same.
    const int use = ++uses[printable(name)];
    models.push_back({use == 1 ? name : fmt::format("{}-{}", name, use), source});
  }
  return models;
}

std::vector<std::string> matching_models(const std::string& pattern) {
  if (is_shape(pattern)) {
    shape_of(pattern);
    return {pattern};
  }
  // A file whose name has brackets or stars in it is no pattern.
  if (fs::exists(pattern)) return surface_files({pattern});
  glob_t found{};
  const int status = ::glob(pattern.c_str(), 0, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  ::globfree(&found);
  if (status != 0)
    throw Error(Cause::CannotOpen, "no file matches " + pattern +
                                       (fs::path(pattern).is_absolute()
                                            ? std::string()
                                            : ", looked for from the working folder " + fs::current_path().string()));
  return surface_files(paths);
}

SurfaceFile read_model(const std::string& source, const ReadOptions& options) {
  if (!is_shape(source)) return read_surface(source, options);
  return {shape_of(source).make(), {}, {}};
}

}  // namespace gsp
