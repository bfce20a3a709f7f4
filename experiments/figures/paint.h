#pragma once

#include <vector>

#include "experiments/figures/render.h"
#include "metrics/picture.h"
#include "param/map/parameterization.h"

namespace gsp {

// Colours of surfaces. Each paint keeps what it needs; the maps and meshes that it is given may go.

/// #P light colours, such that neighbours differ, those across an edge before those across a corner. O(P).
std::vector<Colour> patch_colours(const BaseComplex& base);

/// The same everywhere, the gray of plaster.
Paint plain_paint();
/// A light colour for each patch, cut where the map cuts the faces; neighbours differ. O(F).
Paint patch_paint(const Parameterization& map);
/// #F values by a scale.
Paint face_value_paint(std::vector<double> values, const ColourScale& scale);
/// #V values, linear between the corners of a face, by a scale.
Paint vertex_value_paint(const Mesh& mesh, std::vector<double> values, const ColourScale& scale);

/// Over another paint the lines on which a barycentric coordinate of a patch is a multiple of 1 / `density`, all three
/// families. They are the same lines in every chart, so a kink where they cross a patch edge is one of the map.
Paint with_isolines(Paint under, const Parameterization& map, int density);
/// Over another paint the edges of the patches, darker and wider.
Paint with_patch_edges(Paint under, const Parameterization& map);
/// Over another paint the base edges that are creases, darker and wider than those of the patches. `under` itself for a
/// map without creases.
Paint with_creases(Paint under, const Parameterization& map);
/// Over another paint every edge of the mesh.
Paint with_wireframe(Paint under);

}  // namespace gsp
