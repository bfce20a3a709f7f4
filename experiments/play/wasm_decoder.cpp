#include "experiments/play/wasm_decoder.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "coder/codec.h"
#include "coder/header.h"
#include "mesh/error.h"

struct GspStream {
  gsp::Bytes bytes;
  std::size_t header_bytes = 0;
  std::vector<gsp::SubdivisionLevel> levels;  ///< from the base on, as far as they were asked for
  gsp::SemiregularMesh mesh;

  const gsp::SubdivisionLevel& level(int wanted) {
    while (static_cast<int>(levels.size()) <= wanted) levels.push_back(gsp::subdivide(levels.back()));
    return levels[wanted];
  }
};

namespace {

std::string failure;

/// What `work` returns, or nothing where it throws, which `failure` tells.
template <class Work>
auto guarded(Work work) -> decltype(work()) {
  try {
    return work();
  } catch (const gsp::Error& error) {
    failure = std::string(cause_name(error.cause())) + ": " + error.what();
  } catch (const std::bad_alloc&) {
    failure = std::string(cause_name(gsp::Cause::OutOfMemory)) + ": there is not enough memory";
  } catch (const std::exception& error) {
    failure = std::string(cause_name(gsp::Cause::Internal)) + ": " + error.what();
  }
  return {};
}

}  // namespace

GspStream* gsp_open(const std::uint8_t* bytes, std::size_t count) {
  return guarded([&] {
    auto stream = std::make_unique<GspStream>();
    stream->bytes.assign(bytes, bytes + count);
    stream->header_bytes = gsp::header_bytes(stream->bytes);
    if (stream->header_bytes > count) throw gsp::Error(gsp::Cause::Truncated, "the stream ends in its header");
    const gsp::StreamHeader header = gsp::read_header(stream->bytes.data(), stream->bytes.data() + count);
    stream->levels.push_back(gsp::base_level(header.base.vertices, header.base.faces));
    return stream.release();
  });
}

void gsp_close(GspStream* stream) { delete stream; }

std::size_t gsp_header_bytes(const GspStream* stream) { return stream->header_bytes; }

int gsp_decode(GspStream* stream, std::size_t bytes, int finest) {
  return guarded([&] {
    gsp::SemiregularMesh mesh = gsp::decode(stream->bytes, bytes);
    mesh.level = std::clamp(finest, 0, mesh.level);
    mesh.positions.resize(stream->level(mesh.level).vertex_count);
    stream->mesh = std::move(mesh);
    return 1;
  });
}

int gsp_level(const GspStream* stream) { return stream->mesh.level; }

int gsp_vertex_count(const GspStream* stream) { return static_cast<int>(stream->mesh.positions.size()); }

int gsp_face_count(const GspStream* stream) {
  return static_cast<int>(stream->mesh.base_faces.size()) << (2 * stream->mesh.level);
}

const double* gsp_positions(const GspStream* stream) { return stream->mesh.positions.front().data(); }

const std::int32_t* gsp_faces(GspStream* stream) { return stream->level(stream->mesh.level).faces.front().data(); }

int gsp_crease_count(const GspStream* stream) { return static_cast<int>(stream->mesh.creases.size()); }

const std::int32_t* gsp_creases(const GspStream* stream) {
  return reinterpret_cast<const std::int32_t*>(stream->mesh.creases.data());
}

const char* gsp_error() { return failure.c_str(); }
