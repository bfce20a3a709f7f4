#pragma once

#include <cstdint>
#include <vector>

#include "remesh/semiregular.h"

namespace gsp {

using Bytes = std::vector<std::uint8_t>;

/// Base faces in the order in which they are coded, and what they were called before.
struct CodedBase {
  int vertices = 0;
  std::vector<Triangle> faces;     ///< vertices numbered by first appearance
  Creases creases;                 ///< of these vertices
  std::vector<int> corners;        ///< those at which a crease bends
  std::vector<int> source_vertex;  ///< #V, index in the encoder's input
  std::vector<int> source_face;    ///< #F, index in the encoder's input
  std::vector<int> source_corner;  ///< #F, corner of that face which is corner 0 here
};

/// Appends the connectivity of any oriented triangle mesh without edges of more than two faces: faces are added one by
/// one at an open side, always closing the fan of one vertex first, and each costs what the valences so far leave
/// uncertain (Touma and Gotsman 1998 in spirit; handles, boundaries and several components need no special case). O(F).
/// Faces and creases must have passed `base_level`. Vertices without a face are lost. Creases, if there are any, follow
/// (base_creases.h).
CodedBase encode_connectivity(const std::vector<Triangle>& faces, Bytes& out, const Creases& creases = {},
                              const std::vector<int>& corners = {});

/// Reads `face_count` faces back from [begin, end), and creases where `creased`; `source_*` stay empty. Takes memory in
/// proportion to the faces that the bytes really hold. Throws Error(BadStream).
CodedBase decode_connectivity(int face_count, bool creased, const std::uint8_t* begin, const std::uint8_t* end);

}  // namespace gsp
