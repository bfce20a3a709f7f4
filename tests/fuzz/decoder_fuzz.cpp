#include <cstdint>

#include "coder/codec.h"
#include "coder/header.h"
#include "mesh/error.h"

/// A coded mesh must decode or be refused by name, whatever its bytes. The checksum is set right first, or no mutation
/// of a header would get past it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  gsp::Bytes stream(data, data + size);
  try {
    gsp::seal_header(stream);
    const gsp::SemiregularMesh mesh = gsp::decode(stream, stream.size());
    if (mesh.positions.empty()) __builtin_trap();
    for (const gsp::Vec3& p : mesh.positions)
      if (!p.allFinite()) __builtin_trap();
  } catch (const gsp::Error&) {
  }
  return 0;
}
