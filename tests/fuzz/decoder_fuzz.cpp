#include <cstdint>

#include "coder/codec.h"
#include "coder/header.h"
#include "mesh/error.h"

namespace {

/// A few bytes may claim, and decode to, half a million faces (coder/codec.cpp), of which the first few hundred run
/// through the same code: of larger meshes only the header is read here, or a run would take half a second.
/// tests/coder/hostile_test.cpp has some.
constexpr std::int64_t kMostFaces = 256;

}  // namespace

/// A coded mesh must decode or be refused by name, whatever its bytes. The checksum is set right first, or no mutation
/// of a header would get past it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gsp::Bytes stream(data, data + size);
  try {
    gsp::seal_header(stream);
    const gsp::StreamHeader header = gsp::read_header(stream.data(), stream.data() + stream.size());
    constexpr int kNotForTheCorpus = -1;
    if (static_cast<std::int64_t>(header.base.faces.size()) << 2 * header.level > kMostFaces) return kNotForTheCorpus;
    const gsp::SemiregularMesh mesh = gsp::decode(stream, stream.size());
    if (mesh.positions.empty()) __builtin_trap();
    for (const gsp::Vec3& p : mesh.positions)
      if (!p.allFinite()) __builtin_trap();
  } catch (const gsp::Error&) {
  }
  return 0;
}
