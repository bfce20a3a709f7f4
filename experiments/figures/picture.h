#pragma once

#include <optional>
#include <string>

#include "experiments/figures/render.h"
#include "mesh/io.h"
#include "mesh/progress.h"
#include "metrics/picture.h"
#include "param/map/parameterization.h"
#include "remesh/remesh.h"

namespace gsp {

/// What a picture shows.
enum class Subject {
  Patches,     ///< of a map: the patches in colours, their edges dark, creases wider
  Isolines,    ///< of a map: lines of constant barycentric coordinate, patch edges dark
  Distortion,  ///< of a map: one of its measures
  Smoothness,  ///< of a map: jumps of the first derivatives (the paper's figure 1)
  Remesh,      ///< of a map: wireframe of the remesh at a level, patch edges dark, creases wider
  Wireframe,   ///< of any surface; of a map or semi-regular mesh read as it is, with its creases
  Surface,     ///< of any surface: its shape alone
  Distance,    ///< of any surface: how far each vertex is from another surface
};

inline constexpr Subject kSubjects[] = {Subject::Patches, Subject::Isolines,  Subject::Distortion, Subject::Smoothness,
                                        Subject::Remesh,  Subject::Wireframe, Subject::Surface,    Subject::Distance};

/// "patches", "isolines", ...
const char* subject_name(Subject subject);

struct PictureOptions {
  Subject subject = Subject::Patches;
  std::string measure = "anisotropy";  ///< of Distortion: one of `map_measure_names()`
  int density = 8;                     ///< of Isolines: lines a patch in each direction, 1..1024
  RemeshOptions remesh;                ///< of Remesh
  ReadOptions read;                    ///< how surfaces are read
  std::string other;                   ///< of Distance: file of the surface to measure to
  View view;
  RenderOptions render;
};

struct Picture {
  Image image;
  std::optional<ColourScale> scale;  ///< of what is shown in colours by value; a distance in the coordinates' unit
};

/// Picture of a map. Distance measures from its surface. Throws what rendering, remeshing and measuring throw.
Picture map_picture(const Parameterization& map, const PictureOptions& options, Progress& progress);

/// Picture of a surface of which no map is known. Throws Error(BadOption) for a subject that needs one.
Picture mesh_picture(const Mesh& mesh, const PictureOptions& options);

/// Picture of a file: for subjects of a map, a map (`*.param.ply`) or a semi-regular mesh (`*.sr.ply`), which is a map
/// of itself; for the others any surface. What a file is says its content, not its name. Throws what reading it throws,
/// too.
Picture file_picture(const std::string& path, const PictureOptions& options, Progress& progress);

}  // namespace gsp
