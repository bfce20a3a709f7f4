#pragma once

#include <algorithm>
#include <memory>
#include <numeric>

#include "param/refined/editable_atlas.h"
#include "tests/support/exact_maps.h"

namespace gsp {

/// The map of a mesh onto itself: each face is a base face.
inline Atlas own_base(const Mesh& mesh) { return atlas_of(exact_maps::quadrisected(mesh, 0)); }

/// A map of a surface that nothing was added to yet.
inline EditableAtlas untouched(Atlas atlas) {
  std::vector<int> vertex(atlas.surface->mesh.positions.size()), halfedge(3 * atlas.surface->mesh.faces.size());
  std::iota(vertex.begin(), vertex.end(), 0);
  std::iota(halfedge.begin(), halfedge.end(), 0);
  RefinedSurface refined(atlas.surface);
  return {std::move(refined), std::move(atlas), std::move(vertex), std::move(halfedge)};
}

/// Squared lengths of the edges' images, face by face: they do not depend on charts.
inline std::vector<double> image_lengths(const Atlas& atlas) {
  std::vector<double> squares;
  for (int f = 0; f < atlas.surface->mesh.face_count(); ++f) {
    const auto z = atlas.face_corners(f, atlas.face_frame(f));
    for (int k = 0; k < 3; ++k) squares.push_back(std::norm(z[(k + 1) % 3] - z[k]));
  }
  return squares;
}

inline double largest_change(const std::vector<double>& before, const std::vector<double>& after) {
  if (before.size() != after.size()) return 1e300;
  double largest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) largest = std::max(largest, std::abs(after[i] - before[i]));
  return largest;
}

}  // namespace gsp
