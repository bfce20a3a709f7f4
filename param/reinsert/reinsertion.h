#pragma once

#include <optional>

#include "param/refined/editable_atlas.h"
#include "param/removal/removal_record.h"

namespace gsp {

/// Puts the vertices of a decimation back, the last one first, into a map of what it left, which has no folds: each
/// goes into the hole of its star, where it sees the hole's whole border, so that the faces around it are upright
/// (progressive embedding, Shen et al. 2019). Where it would see too little, its neighbours are moved first, so that
/// the hole takes the shape of its star in the plane. Vertices that were added in the hole go out. Nothing where a
/// vertex found no place, which `unplaced` then names by its number in the decimated surface. O(V).
std::optional<EditableAtlas> reinsert(const RemovalRecord& decimation, const EditableAtlas& map,
                                      std::optional<int>* unplaced = nullptr);

}  // namespace gsp
