#pragma once

#include <string>
#include <vector>

#include "mesh/io.h"

namespace gsp {

/// A surface by where it comes from: a file, or "shape:NAME" for a generated one.
struct ModelSource {
  std::string name;  ///< file name without folder and ending, or the shape's name; numbered where two would share one
  std::string source;
};

/// The surfaces that paths name: files as they are, folders by their PLY, OBJ, OFF and STL files in name order.
/// Throws Error(CannotOpen) where a folder holds none.
std::vector<std::string> surface_files(const std::vector<std::string>& paths);

/// Surfaces with their names, in order.
std::vector<ModelSource> named_models(const std::vector<std::string>& sources);

/// What a pattern of a recipe names: "shape:NAME", a file, a folder, or files by *, ? and [] in name order. Relative
/// ones start from the working folder. Throws Error(CannotOpen) where nothing matches, Error(BadOption) for an unknown
/// shape.
std::vector<std::string> matching_models(const std::string& pattern);

/// Names after "shape:".
std::vector<std::string> shape_names();

/// Reads or generates a surface. Throws the errors of `read_surface`, and BadOption for an unknown shape.
SurfaceFile read_model(const std::string& source, const ReadOptions& options = {});

}  // namespace gsp
