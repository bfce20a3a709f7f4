#pragma once

#include "param/refined/editable_atlas.h"

namespace gsp {

/// Takes added vertices out of a map again where it stays upright, and its pieces thick enough, without them, also on
/// edges of the base. Patch corners stay. O(V).
EditableAtlas coarsen(EditableAtlas map);

}  // namespace gsp
