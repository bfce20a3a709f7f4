#pragma once

#include <bit>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "coder/codec.h"

namespace gsp::golden {

inline Bytes read(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

/// FNV-1a over the bits of all coordinates, the base faces and creases: two hashes agree where the decoded meshes do,
/// bit for bit.
inline std::uint64_t hash(const SemiregularMesh& mesh) {
  std::uint64_t sum = 0xcbf29ce484222325u;
  const auto add = [&](std::uint64_t word) {
    for (int b = 0; b < 8; ++b) sum = (sum ^ (word >> (8 * b) & 255)) * 0x100000001b3u;
  };
  add(mesh.level);
  for (const Triangle& t : mesh.base_faces)
    for (int v : t) add(v);
  for (const auto& [a, b] : mesh.creases) {
    add(a);
    add(b);
  }
  for (const Vec3& p : mesh.positions)
    for (int k = 0; k < 3; ++k) add(std::bit_cast<std::uint64_t>(p[k]));
  return sum;
}

/// Of a stream's whole and of its first half: what tests/coder/golden/hashes.txt holds of each file.
inline std::vector<std::uint64_t> hashes(const Bytes& stream) {
  return {hash(decode(stream, stream.size())), hash(decode(stream, stream.size() / 2))};
}

}  // namespace gsp::golden
