#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace gsp {

/// One number per vertex or per face, for a viewer.
struct PictureColumn {
  std::string name;
  std::vector<double> values;
};

/// How the first column becomes colour: gray at `neutral`, red at `full` and beyond, linear between, as in the paper's
/// figure 1. `full` may be the smaller one; where they agree all is gray.
struct ColourScale {
  double neutral = 0.0;
  double full = 1.0;
};

/// Red, green, blue in [0, 255] of a value; that of `neutral` where it is not finite.
std::array<double, 3> colour_of(const ColourScale& scale, double value);

/// Binary PLY of the surface with the columns as properties of its vertices, and red, green, blue by the first column,
/// which is also written as `quality`, the name MeshLab reads. Values that are not finite become 0.
/// Columns hold #V values. Throws Error(CannotWrite).
void write_vertex_picture(const std::string& path, const Mesh& mesh, const std::vector<PictureColumn>& columns,
                          const ColourScale& scale);

/// The same with properties of the faces; columns hold #F values.
void write_face_picture(const std::string& path, const Mesh& mesh, const std::vector<PictureColumn>& columns,
                        const ColourScale& scale);

}  // namespace gsp
