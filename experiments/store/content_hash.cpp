#include "experiments/store/content_hash.h"

#include <xxhash.h>

#include <cstdint>

#include "mesh/read_file.h"

namespace gsp {

std::string content_hash(std::string_view bytes) {
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes.data(), bytes.size()));
  std::string text;
  for (unsigned char byte : canonical.digest) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string file_hash(const std::string& path) { return content_hash(read_file(path)); }

std::string mesh_hash(const Mesh& mesh) {
  std::string bytes;
  bytes.reserve(mesh.positions.size() * sizeof(double) * 3 + mesh.faces.size() * sizeof(Triangle));
  for (const Vec3& p : mesh.positions) bytes.append(reinterpret_cast<const char*>(p.data()), sizeof(double) * 3);
  for (const Triangle& t : mesh.faces) bytes.append(reinterpret_cast<const char*>(t.data()), sizeof(Triangle));
  // The counts tell where positions end.
  return content_hash(bytes + ' ' + std::to_string(mesh.vertex_count()) + ' ' + std::to_string(mesh.face_count()));
}

}  // namespace gsp
