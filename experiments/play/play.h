#pragma once

#include <cstddef>
#include <string>

#include "coder/codec.h"

namespace gsp {

/// A page that plays a stream, and what the stream is.
struct PlayPage {
  std::string html;
  std::size_t header_bytes = 0;  ///< that the shortest prefix has
  int level = 0;                 ///< of the whole stream
  int shown_level = 0;           ///< the finest one that the page shows
  std::size_t vertices = 0;      ///< of the whole stream
};

/// A page that stands alone: it opens from disk without a network and decodes the stream itself, any prefix of it, as
/// the reader moves a slider over its bytes. Levels with more than 2^19 faces are not shown. `title` may hold any
/// bytes. Throws Error(ToolMissing) where this program was built without emscripten, and what `decode` throws.
PlayPage play_page(const Bytes& stream, const std::string& title);

}  // namespace gsp
