#pragma once

#include <cstddef>
#include <cstdint>

/// The decoder as a WebAssembly module shows it to JavaScript (page/decoder.js), which has neither exceptions nor C++'s
/// types. Functions that can fail return null or 0, and `gsp_error` tells why.
extern "C" {

struct GspStream;

/// A stream of which the bytes are copied; it ends with `gsp_close`. Null where they do not begin with a whole header.
GspStream* gsp_open(const std::uint8_t* bytes, std::size_t count);
void gsp_close(GspStream* stream);

/// Bytes that a prefix needs at least.
std::size_t gsp_header_bytes(const GspStream* stream);

/// Decodes the first `bytes` bytes, of which the mesh stays until the next call: at its own level, or at `finest` where
/// that is coarser, vertices of finer levels left out. 1 where done. Cost: that of `gsp::decode`.
int gsp_decode(GspStream* stream, std::size_t bytes, int finest);

// Of what was decoded last.
int gsp_level(const GspStream* stream);
int gsp_vertex_count(const GspStream* stream);
int gsp_face_count(const GspStream* stream);
/// #V by 3.
const double* gsp_positions(const GspStream* stream);
/// #F by 3, in the order of gsp::SubdivisionLevel: those of base face f are 4^level·f and following.
const std::int32_t* gsp_faces(GspStream* stream);

/// Base edges across which the surface is not smooth: #C by 2, base vertices.
int gsp_crease_count(const GspStream* stream);
const std::int32_t* gsp_creases(const GspStream* stream);

/// The cause's name and a sentence of the last call that failed: "bad-stream: ...".
const char* gsp_error();
}
