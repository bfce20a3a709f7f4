#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/cut_apart.h"
#include "mesh/error.h"
#include "mesh/export.h"
#include "mesh/mesh.h"

namespace GSP_PUBLIC gsp {

/// How a file counts the vertices and polygons that a surface was read from.
struct Numbering {
  int first = 0;                   ///< number of the first vertex and of the first polygon: 1 in OBJ
  std::vector<int> vertices = {};  ///< #V number from 0 in the file; empty where it is the surface's own
  std::vector<int> polygons = {};  ///< #F the same of the polygon that the face is cut from
};

/// A surface as a file holds it, and what reading it had to decide.
struct SurfaceFile {
  Mesh mesh;
  Numbering numbering;
  std::optional<CutCounts> cuts = {};   ///< where it was cut apart
  std::vector<std::string> notes = {};  ///< sentences on what the file holds and the surface does not, for people
};

/// The error with vertices and faces of the mesh told as the file counts them.
Error in_file(const Error& error, const Numbering& numbering);

/// Joins vertices of the file's surface as `weld` of weld.h does, and drops the faces that this leaves with fewer than
/// three corners. Notes how many.
void weld(SurfaceFile& file, double share);

/// Cuts the file's surface apart as `cut_apart` of cut_apart.h does. Counts and notes what was cut.
void cut_apart(SurfaceFile& file);

/// Calls the action, whose errors are about the file's surface.
template <class Action>
auto in_places_of(const SurfaceFile& file, Action&& action) {
  try {
    return action();
  } catch (const Error& error) {
    throw in_file(error, file.numbering);
  }
}

}  // namespace gsp
