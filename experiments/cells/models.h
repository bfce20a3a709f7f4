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

/// True for "shape:NAME".
bool is_shape(const std::string& source);

/// Where a surface lies, however its path is spelled ("m.off", "./m.off"): the same text for the same file. Links are
/// not followed, since names of links are names of models.
std::string surface_place(const std::string& source);

/// The surfaces that paths name: files as they are, folders by their PLY, OBJ, OFF and STL files in name order; one
/// that is named twice once. Throws Error(CannotOpen) where a folder holds none or cannot be listed.
std::vector<std::string> surface_files(const std::vector<std::string>& paths);

/// Surfaces with their names, in order.
std::vector<ModelSource> named_models(const std::vector<std::string>& sources);

/// What a pattern of a recipe names: "shape:NAME", a file, a folder, or files by *, ? and [] in name order; what exists
/// is taken as it is, also where such characters are part of its name. Relative ones start from the working folder.
/// Throws Error(CannotOpen) where nothing matches, Error(BadOption) for an unknown shape.
std::vector<std::string> matching_models(const std::string& pattern);

/// Names after "shape:".
std::vector<std::string> shape_names();

/// Reads or generates a surface. Throws the errors of `read_surface`, and BadOption for an unknown shape.
SurfaceFile read_model(const std::string& source, const ReadOptions& options = {});

}  // namespace gsp
